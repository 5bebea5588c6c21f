#!/usr/bin/env bash
# The example projects of data/examples, built against the library as somebody else would: what they
# print, the status they end with, numbers beside their closed forms; and every command of
# docs/your_own_system.md with the output that stands there.
set -u
cd "$(dirname "$0")/.." || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
failures=0
count=0

check() { # check CLAIM COMMAND...: the claim holds if the command succeeds
    count=$((count + 1))
    if ("${@:2}") >"$work/why" 2>&1; then
        printf 'ok      %s\n' "$1"
    else
        printf 'FAILED  %s\n' "$1"
        sed 's/^/        | /' "$work/why" "$work/err" | head -n 40
        failures=$((failures + 1))
    fi
}

run() { # run PROGRAM WORDS...: its status, its stdout in $work/out, its stderr in $work/err
    timeout 60 "$@" >"$work/out" 2>"$work/err" </dev/null
    status=$?
}

json() { # json EXPRESSION: stdout is JSON, and the expression about it, in Python, is true
    python3 -c 'import json, math, sys
d = json.load(open(sys.argv[1]))
sys.exit(0 if eval(sys.argv[2]) else repr(d))' "$work/out" "$1"
}

near() { # near TOLERANCE EXPECTED ACTUAL...: numbers; as many of both, awk's precision is enough
    awk -v eps="$1" -v want="$2" -v have="${*:3}" 'BEGIN {
        n = split(want, w, " "); if (split(have, h, " ") != n) exit 1
        for (i = 1; i <= n; i++) if (!((w[i] - h[i])^2 <= eps^2)) exit 1 }'
}

prefix=$(bash .ci/installed.sh) || exit 1

against_installed() { # against_installed NAME: a copy of this example that links the installed library
    cp -r "data/examples/$1" "$work/$1" && rm -rf "$work/$1/build" || exit 1
    sed -i -e '/^\[dependencies\]/,/^$/d' -e 's/^link = \[/external-modules = ["lagrangia"]\n&"lagrangia", "gomp", /' "$work/$1/fpm.toml"
    fpm build -C "$work/$1" --profile release --flag "-I$prefix/include" --link-flag "-L$prefix/lib" >"$work/err" 2>&1 ||
        { tail -n 20 "$work/err"; exit 1; }
}

# Normal modes of somebody's own matrices, with the library as a dependency: .ci/any_x86_64.sh
for name in solve spherical_pendulum; do
    check "$name: the library is a dependency as in normal_modes" cmp \
        <(sed -n '/^link/p; /^\[dependencies\]/,/^$/p' data/examples/normal_modes/fpm.toml) \
        <(sed -n '/^link/p; /^\[dependencies\]/,/^$/p' data/examples/$name/fpm.toml)
done

# The motion at given times
against_installed solve
run "$(ls -t "$work"/solve/build/gfortran_*/app/cart | head -n 1)"
check "solve: status 0, a line a time" eval '[ $status -eq 0 ] && [ "$(wc -l <"$work/out")" -eq 11 ]'
check "solve: (m1 + m2) x + m2 l sin(theta) is conserved, 3 x + sin(theta) = sin(1)" eval '
    awk "{ d = 3*\$2 + sin(\$3) - sin(1); if (d*d > 1e-14) bad = 1 } END { exit bad }" "$work/out"'
check "the docstring of the module lagrangia is this program" eval '
    sed -n "s/^    !!     //p; s/^    !!$//p" src/lagrangia.f90 | grep -A 100 "^program cart" |
        sed "/^end program cart/q" | diff - data/examples/solve/app/main.f90'

# The installed library, as it is
rm -rf data/examples/installed/build
fpm build -C data/examples/installed --flag "-I$prefix/include" --link-flag "-L$prefix/lib" >"$work/err" 2>&1 || { tail -n 20 "$work/err"; exit 1; }
run "$(ls -t data/examples/installed/build/gfortran_*/app/periods | head -n 1)"
check "installed: omega^2 = (m1 + m2) g/(m1 l)" near 1e-8 "19.62 14.715 13.08 12.2625" "$(sed 's/.*=//; s/s^-2//' "$work/out")"
check "installed: nothing of lagrangia is compiled again" eval '[ "$(find data/examples/installed/build -name "*.o" | wc -l)" -eq 1 ]'
mkdir "$work/elsewhere"
(cd "$work/elsewhere" && "$prefix/bin/lagrangia" run pendulum) >"$work/out" 2>"$work/err"
check "installed: a scene by its name, from any folder" eval 'grep -q "^pendulum .* holds$" "$work/out" && [ -s "$work/elsewhere/data/output/pendulum.dat" ]'
python3 .ci/try_fortran.py "$prefix" >"$work/written" || failures=$((failures + 1))
sed '$d' "$work/written"
count=$((count + $(grep -c . "$work/written") - 1))

# Systems of one's own
against_installed spherical_pendulum
root=$PWD
cd "$work/spherical_pendulum" || exit 2
mkdir "$work/bin"
for name in spherical slip; do
    ln -s "$(realpath "$(ls -t build/gfortran_*/app/$name | head -n 1)")" "$work/bin/$name"
done
ln -s spherical "$work/bin/lagrangia" # it is lagrangia, with systems more
export PATH="$work/bin:$PATH"
run spherical list systems
check "list: the lectures' systems, then ours" eval '[ $status -eq 0 ] && [ "$(cut -d" " -f1 "$work/out" | sed -n "1p;14,\$p" | tr "\n" " ")" = "oscillator spherical_pendulum spherical_by_hand spherical_xy " ]'
run spherical --output "$work/all"
check "its scenes hold" eval '[ $status -eq 0 ] && [ "$(grep -c " holds$" "$work/out")" -eq "$(ls data/scenes/*.nml | wc -l)" ]'
check "a data file a scene" eval 'for f in data/scenes/*.nml; do f=${f##*/}; [ -s "$work/all/${f%.nml}.dat" ] || exit 1; done'
run spherical run conical --json --output "$work/o"
check "conical pendulum: period 2 pi sqrt(l cos(theta)/g)" json 'abs(d[0]["period"] - 2*math.pi*math.sqrt(0.8/9.8)) < 1e-10'
run spherical run spherical_pendulum spherical_by_hand --json --output "$work/o"
check "from L as by hand, after 20 s" json 'd[0]["steps"] == 20000 and max(abs(a - b) for a, b in zip(d[0]["q"] + d[0]["v"], d[1]["q"] + d[1]["v"])) < 1e-10'
run spherical run spherical_pendulum --set scene%method=verlet --output "$work/none"
check "plain Verlet is refused: velocities were found in the forces" eval '[ $status -eq 2 ] && grep -q "they depend on velocities" "$work/err" && [ ! -e "$work/none" ]'
for method in stormer_verlet midpoint gauss16; do
    run spherical run spherical_pendulum --set scene%method=$method --set scene%duration=1 --set scene%expect_energy_drift=1e-5 --output "$work/o"
    check "from L alone: $method" [ $status -eq 0 ]
done
run spherical check
check "check: everything holds" [ $status -eq 0 ]
check "check: ours are there" eval 'for name in pendulum by_hand xy; do grep -q "^spherical_$name " "$work/out" || exit 1; done'
run slip check spherical_slip
check "check: the slip is found, and its term is named" eval '[ $status -eq 1 ] && grep -qF "phi_ddot is not that of L: the term in theta_dot phi_dot of the equation of phi counts 0.5 times in it" "$work/out"'
run spherical modes spherical_xy --set spherical_xy%l=0.7 --json
check "modes: g/l, twice" json 'len(d["omega2"]) == 2 and max(abs(w/(9.81/0.7) - 1) for w in d["omega2"]) < 1e-14'
run spherical modes spherical_pendulum
check "modes: status 4 where phi means nothing" eval '[ $status -eq 4 ] && grep -q "the mass matrix d2L/dv dv is singular" "$work/err" && [ ! -s "$work/out" ]'
run spherical principle virtual-work
check "principle: the lectures' systems, as ever" eval '[ $status -eq 0 ] && ! grep -q spherical "$work/out"'
cat >"$work/twice.f90" <<'END'
program twice
    use lagrangia, only: error_t, lagrangia_main, register_system
    use spherical_xy, only: spherical_xy_t
    type(spherical_xy_t) :: mine
    type(error_t), allocatable :: error
    call register_system(mine, error)
    if (.not. allocated(error)) call register_system(mine, error)
    call lagrangia_main(error)
end program twice
END
newest() { ls -t $(find build -name "$1") | head -n 1; }
if gfortran -I"$prefix/include" -I"$(dirname "$(newest spherical_xy.mod)")" "$work/twice.f90" \
    "$(newest libspherical_pendulum.a)" -L"$prefix/lib" -llagrangia -llapack -lblas -lgsl -lgslcblas -lgomp -o "$work/bin/twice" 2>"$work/err"; then
    run twice list systems
fi
check "a name that is taken: one line, status 2" eval '[ $status -eq 2 ] && [ ! -s "$work/out" ] && [ "$(cat "$work/err")" = "lagrangia: system '"'spherical_xy'"': there is a system of that name: give yours another one" ]'

# The walk-through: each ```console block is `$ command` and what it prints, but for times and digits
# that are only rounding; each ```fortran block stands in one of the sources.
walk() {
    python3 - "$1/docs/your_own_system.md" "$1"/data/examples/*/*/*.f90 <<'END'
import re, subprocess, sys
def plain(text):
    text = re.sub(r" \d+\.\d{4} s$", " TIME", text, flags=re.M)
    text = re.sub(r"(\d\.\d{11})\d+E", r"\1E", text)
    return [re.sub(r"\d(\.\d+)?[Ee]-(0?9|1\d)", "~", line).rstrip() for line in text.splitlines()]
def stripped(text): return "\n".join(line.strip() for line in text.splitlines())
text = open(sys.argv[1]).read()
sources = [stripped(open(name).read()) for name in sys.argv[2:]]
bad = commands = 0
for block in re.findall(r"```console\n(.*?)```", text, re.S):
    for command, expected in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", block, re.M):
        commands += 1
        got = subprocess.run(command, shell=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT).stdout
        if plain(got) != plain(expected):
            bad += 1
            print(f"$ {command}\n--- documented\n{expected}--- printed\n{got}")
scenes = re.findall(r"```namelist\n(.*?)```", text, re.S)
if scenes != [open("spring_pendulum.nml").read()]:
    bad += 1
    print("the scene is not data/scenes/spring_pendulum.nml")
blocks = re.findall(r"```fortran\n(.*?)```", text, re.S)
for block in blocks:
    if not any(stripped(block) in source for source in sources):
        bad += 1
        print(f"in no source:\n{block}")
print(f"{commands} commands, {len(blocks)} pieces of code, {bad} differ")
sys.exit(bad > 0 or commands != 16 or len(blocks) != 4)
END
}
mkdir "$work/walk" && cp -r data "$root/data/scenes/spring_pendulum.nml" "$work/walk" && cd "$work/walk" || exit 2
check "docs/your_own_system.md: commands print what it says" walk "$root"

echo "$count claims, $failures failed"
exit $((failures > 0))
