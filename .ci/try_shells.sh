#!/usr/bin/env bash
# Completion in a real bash and a real zsh, typed with Tab, and the manual page as man, groff and
# mandoc read it. What is not installed is not tried, and that is said.
#
#   .ci/try_shells.sh [PROGRAM]
set -u
cd "$(dirname "$0")/.." || exit 2
program=$(realpath "${1:-$(ls -t build/gfortran_*/app/lagrangia | head -n 1)}") || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
failures=0
count=0

check() { # check CLAIM COMMAND...: the claim holds if the command succeeds
    count=$((count + 1))
    if "${@:2}" >"$work/log" 2>&1; then
        printf 'ok      %s\n' "$1"
    else
        printf 'FAILED  %s\n' "$1"
        head -n 5 "$work/log" | sed 's/^/        | /'
        failures=$((failures + 1))
    fi
}

completes() { # completes SHELL TYPED EXPECTED: TYPED, Tab and Enter make the shell run EXPECTED
    python3 - "$work" "$@" <<'PYTHON'
import os, pty, re, select, sys, time
folder, shell, typed, expected = sys.argv[1:]
start = {"bash": ["bash", "--norc", "--noprofile", "-i"], "zsh": ["zsh", "-f", "-i"]}[shell]
pid, terminal = pty.fork()
if pid == 0:
    os.chdir(folder)
    os.environ.update(TERM="dumb", PS1="> ", HISTFILE="/dev/null")
    os.execvp(start[0], start)
text = b""
def wait(pattern, seconds=15):
    global text
    end = time.time() + seconds
    while time.time() < end and not re.search(pattern, text):
        if select.select([terminal], [], [], 0.2)[0]:
            try:
                text += os.read(terminal, 65536)
            except OSError:
                break
    return re.search(pattern, text)
def send(line):
    os.write(terminal, line.encode())
if shell == "zsh":
    send("autoload -Uz compinit && compinit -D -u\n")
send(f". ./completion.{shell}\nlagrangia() {{ echo GOT:\"$*\":END; }}\necho rea''dy\n")
ready = wait(rb"ready\r?\n")
text = b""
send(typed + "\t")
time.sleep(1.0)
send("\n")
found = wait(rb"GOT:([^\r\n$]*):END")
os.kill(pid, 9)
os.waitpid(pid, 0)
got = found and found[1].decode().strip()
if not ready or got != expected:
    print(f"{typed!r} became {got!r}, not {expected!r}", text[-300:])
    sys.exit(1)
PYTHON
}

touch "$work/mine.nml"
for shell in bash zsh; do
    if ! command -v $shell >/dev/null; then
        echo "not tried: there is no $shell"
        continue
    fi
    "$program" completion $shell >"$work/completion.$shell"
    check "$shell: the script is sound" $shell -n "$work/completion.$shell"
    if ! python3 -c 'import pty; pty.openpty()' 2>"$work/log"; then # some containers have no /dev/pts
        echo "not tried: typing to $shell, for there is no pseudo-terminal: $(tail -n 1 "$work/log")"
        continue
    fi
    [ $shell = bash ] && check "bash: --plot= and Tab: what there is" bash -c '. "$1"; COMP_WORDS=(lagrangia run pendulum --plot =)
        COMP_CWORD=4; _lagrangia; [ "${#COMPREPLY[@]}" -gt 1 ] && [[ " ${COMPREPLY[*]} " == *" svg "* && ${COMPREPLY[*]} != *pendulum* ]]' - "$work/completion.bash"
    while IFS='|' read -r typed expected; do
        check "$shell: $typed" completes $shell "$typed" "$expected"
    done <<'END_OF_WORDS'
lagrangia des|describe
lagrangia run pendulum_sep|run pendulum_separatrix
lagrangia run mi|run mine.nml
lagrangia run pendulum --form|run pendulum --format
lagrangia run --format np|run --format npy
lagrangia modes atwoo|modes atwood
lagrangia bench prec|bench precision
lagrangia derive cart_pendulum --slip E29|derive cart_pendulum --slip E29
lagrangia run pendulum --set scene%dur|run pendulum --set scene%duration=
lagrangia run pendulum --set pendulum%l|run pendulum --set pendulum%l=
lagrangia run pendulum --plot=sv|run pendulum --plot=svg
lagrangia grade cart|grade cart_pendulum
END_OF_WORDS
done

"$program" manual >"$work/lagrangia.1"
check "the manual names every command" eval 'for c in $("$program" help nothing_like_it 2>&1 | sed "s/.*there are //; s/,//g"); do grep -q "^.SS $c" "$work/lagrangia.1" || exit 1; done'
if command -v groff >/dev/null; then
    check "groff -ww has no complaint" eval '[ -z "$(groff -ww -man -Tutf8 "$work/lagrangia.1" 2>&1 >/dev/null)" ]'
    check "what groff prints are the words of --help" eval 'groff -man -Tascii -P-c "$work/lagrangia.1" | grep -q "lagrangia run pendulum --set pendulum%l=2 --set scene%dt=1e-3"'
else
    echo "not tried: there is no groff"
fi
if command -v man >/dev/null; then
    check "man -l shows it" eval 'MANWIDTH=80 man -l "$work/lagrangia.1" | grep -q "LAGRANGIA(1)"'
else
    echo "not tried: there is no man"
fi
if command -v mandoc >/dev/null; then
    check "mandoc -T lint has no complaint" mandoc -T lint "$work/lagrangia.1"
else
    echo "not tried: there is no mandoc"
fi
echo "$count claims, $failures failed"
exit $((failures > 0))
