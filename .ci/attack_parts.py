#!/usr/bin/env python3
"""The file of an interrupted sweep, cut, changed, lengthened, emptied, or of another sweep.

`--resume` ends with the table of a sweep that nobody interrupted, byte for byte, and says what was damaged;
or, where the file does not tell this sweep, it is refused and left as it was.

Usage: attack_parts.py PROGRAM; takes ten seconds.
"""
import os
import random
import signal
import subprocess
import sys
import tempfile

WORDS = ["sweep", "pendulum", "--over", "theta=0.1:3:160", "--keep", "period", "--output", "o",
         "--set", "scene%duration=400", "--set", "scene%method='gauss16'", "--set", "scene%tolerance=1e-13", "--set", "scene%output=pendulum"]
TABLE, PART = "o/pendulum_sweep.dat", "o/pendulum_sweep.dat.part"
RECORD = 8*6  # bytes: three words, two trajectories of one number, a check sum


def main():
    program = os.path.abspath(sys.argv[1])
    os.chdir(tempfile.mkdtemp())
    random.seed(7)

    def sweep(*words):
        return subprocess.run([program, *WORDS, *words], capture_output=True, text=True, timeout=100)

    sweep()
    whole = read(TABLE)
    clean()
    part = killed([program, *WORDS, "--threads", "1"])
    lines = part.split(b"\n")
    text = len(lines[0]) + len(lines[1]) + 2 + int(lines[1])
    print(f"killed after {len(part)} bytes, {text} of them text")
    failed = 0
    cases = list(spoiled(part, text))
    for name, tells, sound, content in cases:
        clean()
        os.makedirs("o", exist_ok=True)
        with open(PART, "wb") as file:
            file.write(content)
        got = sweep("--resume", "--threads", random.choice("1235"))
        if tells:
            good = got.returncode == 0 and read(TABLE) == whole and not os.path.exists(PART)
            good = good and ("is damaged at byte" in got.stderr) != sound
        else:
            good = got.returncode == 5 and read(PART) == content and not os.path.exists(TABLE)
            good = good and "is of another sweep" in got.stderr
        failed += not good
        print(f"{'ok     ' if good else 'FAILED '} --resume: {name}", "" if good else got.stderr)
    clean()
    print(f"{len(cases)} claims, {failed} failed")
    return failed > 0


def spoiled(part, text):
    """Name, whether it tells the sweep, whether all of it is sound, and the bytes."""
    yield "an empty file", True, True, b""
    yield "another text", False, False, b"hello\n"*50
    yield "zeros", False, False, bytes(len(part))
    for n in [100, text, text + 1, text + 7, text + 8, text + RECORD - 1, text + RECORD, text + RECORD + 1] + \
            [random.randrange(text, len(part)) for _ in range(8)]:
        yield f"cut to {n} bytes", True, True, part[:n]
    records = (len(part) - text)//RECORD
    for n in [text, text + 7] + [random.randrange(text, text + (records - 1)*RECORD) for _ in range(12)]:
        yield f"a bit of byte {n}", True, False, flipped(part, n)
    for n in [0, text - 1] + [random.randrange(text) for _ in range(4)]:
        yield f"a bit of byte {n} of the text", False, False, flipped(part, n)
    n = text + 3*RECORD + 16
    yield "five words missing", True, False, part[:n] + part[n + 40:]
    yield "five bytes missing", True, False, part[:n] + part[n + 5:]
    yield "three words more", True, False, part[:n] + b"lagrange"*3 + part[n:]
    yield "200 zeros", True, False, part[:n] + bytes(200) + part[n + 200:]
    yield "200 ones", True, False, part[:n] + b"\xff"*200 + part[n + 200:]
    yield "all records twice", True, True, part[:text + records*RECORD] + part[text:]
    yield "a tail of noise", True, False, part[:text + records*RECORD] + random.randbytes(1000)
    yield "only noise behind the text", True, False, part[:text] + random.randbytes(3000)
    yield "only small numbers behind it", True, False, part[:text] + (b"\1" + bytes(7))*400


def flipped(part, n):
    return part[:n] + bytes([part[n] ^ 1 << random.randrange(8)]) + part[n + 1:]


def killed(command):
    """What a sweep has kept that was killed in the middle."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None:
        try:
            if os.path.getsize(PART) > 2500:
                process.send_signal(signal.SIGKILL)
                break
        except FileNotFoundError:  # not yet, or no more
            pass
    process.wait()
    return read(PART)


def read(path):
    with open(path, "rb") as file:
        return file.read()


def clean():
    for path in TABLE, PART, "o/pendulum_sweep.gp":
        if os.path.exists(path):
            os.remove(path)


if __name__ == "__main__":
    sys.exit(main())
