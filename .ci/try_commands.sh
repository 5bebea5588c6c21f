#!/usr/bin/env bash
# The built program as a user types it: what it prints, the status it ends with, the files it leaves.
# Give the program's path, or build it first: fpm build --profile release. What it says of each refusal
# stands whole in .ci/pages/refused_by_commands.txt; where that is meant to change:
#
#   try_commands.sh PROGRAM --accept
set -u
cd "$(dirname "$0")/.." || exit 2
program=${1:-}
if [ -z "$program" ]; then # the newest one; a release build by preference
    for found in $(ls -t build/gfortran_*/app/lagrangia 2>/dev/null); do
        program=${program:-$found}
        if "$found" --version | grep -q ', optimised'; then
            program=$found
            break
        fi
    done
fi
[ -x "$program" ] || { echo "no program: fpm build --profile release"; exit 2; }
program=$(realpath "$program")
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
failures=0
count=0

check() { # check CLAIM COMMAND...: the claim holds if the command succeeds
    count=$((count + 1))
    if ("${@:2}") >/dev/null 2>&1; then
        printf 'ok      %s\n' "$1"
    else
        printf 'FAILED  %s\n' "$1"
        printf '        | %s\n' "status $status" "stdout: $(head -c 300 "$work/out")" "stderr: $(head -c 300 "$work/err")"
        failures=$((failures + 1))
    fi
}

run() { # run WORDS...: the program; its status, its stdout in $work/out, its stderr in $work/err
    timeout 120 "$program" "$@" >"$work/out" 2>"$work/err" </dev/null
    status=$?
    if grep -q ' $' "$work/out" "$work/err"; then echo "$*" >>"$work/blanks"; fi
}

one_line() { # one line of at most 300 bytes on stderr, by us, and no backtrace
    [ "$(wc -l <"$work/err")" -eq 1 ] && [ "$(wc -c <"$work/err")" -le 301 ] && grep -q '^lagrangia: ' "$work/err" && ! grep -qi 'backtrace\|#0 ' "$work/err"
}

kept=.ci/pages/refused_by_commands.txt
accept=${2:-}
[ "$accept" != --accept ] || : >"$kept"

refuses() { # refuses STATUS TEXT WORDS...: one line on stderr with TEXT, no blanks but the user's that are too many, nothing on stdout, this status
    local text=$2 words=${*:3}
    run "${@:3}"
    if [ "$(wc -c <"$work/err")" -lt 230 ]; then # what is longer may be cut, by the length of a path
        local said # without digits that may be another processor's
        said=$(printf '%.120s: %s' "${words//"$work"/WORK}" "$(cat "$work/err")" | tr '\n' ' ' | sed "s|$work|WORK|g; s/\(\.[0-9]\{6\}\)[0-9]*/\1/g")
        [ "$accept" != --accept ] || printf '%s\n' "$said" >>"$kept"
        check "kept word for word: ${*:3}" grep -qxF -- "$said" "$kept"
    fi
    check "status $1: ${*:3}" eval '[ $status -eq '"$1"' ] && one_line && [ ! -s "$work/out" ] && grep -qF -- "$text" "$work/err" && { [[ $words = *"  "* ]] || ! grep -q "  \| $" "$work/err"; }'
}

leftovers() { # no temporary file anywhere below $work
    [ -z "$(find "$work" -name '.lagrangia-*')" ]
}

json() { # json EXPRESSION: stdout is JSON, and the expression about it, in Python, is true
    python3 -c 'import json, sys
def no(text): raise ValueError(text)
d = json.load(open(sys.argv[1]), parse_constant=no)
sys.exit(0 if eval(sys.argv[2]) else 1)' "$work/out" "$1"
}

# The main job
run --output "$work/all"
check "main job: status 0" [ "$status" -eq 0 ]
check "main job: nothing on stderr but remarks on steps and methods" eval '! grep -v -e "steps (" -e ": auto took " "$work/err"'
scenes=$(ls data/scenes/*.nml | wc -l)
check "main job: a row a scene" eval '[ "$(grep -c " holds$" "$work/out")" -eq "$scenes" ]'
check "main job: a data file and a script a scene" eval 'for f in data/scenes/*.nml; do f=${f##*/}; [ -s "$work/all/${f%.nml}.dat" ] && [ -s "$work/all/${f%.nml}.gp" ] || exit 1; done'
check "main job: the header says what auto took" grep -q "^# auto took exact: closed form: " "$work/all/cart_pendulum_auto.dat"
check "main job: no temporary left" leftovers
cp "$work/out" "$work/text"
run --json --output "$work/again"
check "main job: the scorecard's rows are the JSON's" python3 .ci/scorecard_text.py "$work/text" "$work/out"
check "the same bytes again" diff -r "$work/all" "$work/again"

names=$(ls data/scenes/*.nml | sed 's,.*/,,; s,.nml,,')
# shellcheck disable=SC2086  # several names
run run $names --output "$work/again"
cp "$work/out" "$work/text"
check "run: rows and the lines below them are in 80 columns, remarks behind them" eval 'cat "$work/out" "$work/err" | head -n 1 | grep -q "^scene " && ! grep -q "auto took" "$work/out"'
# shellcheck disable=SC2086
run run $names --json --output "$work/again"
check "run: the lines below the rows are the JSON's" python3 .ci/scorecard_text.py "$work/text" "$work/out" all

# The scene goes with every format, and no format writes over the files of another
for format in csv npy text; do run run bouncing_ball --format $format --output "$work/formats"; done
check "formats: a script each, and the scene beside csv and npy" eval '[ "$(ls "$work/formats" | grep -vc events | tr -d " ")" -eq 8 ] && grep -q "bouncing_ball.csv" "$work/formats/bouncing_ball.csv.gp" && grep -q "bouncing_ball.npy" "$work/formats/bouncing_ball.npy.gp" && grep -q "bouncing_ball.dat" "$work/formats/bouncing_ball.gp"'
for format in csv npy; do
    run run "$work/formats/bouncing_ball.$format.nml" --set scene%output=bouncing_ball --output "$work/formats/again"
    check "formats: the scene beside $format gives the same bytes" cmp "$work/formats/bouncing_ball.dat" "$work/formats/again/bouncing_ball.dat"
done
check "formats: units, build and what auto took stand there" eval 'grep -q "^! columns: t\[s\] y\[m\] " "$work/formats/bouncing_ball.csv.nml" && grep -q "^! build: GCC" "$work/formats/bouncing_ball.npy.nml" && grep -q "^! auto took gauss16" "$work/formats/bouncing_ball.npy.nml"'

# Help
refuses 2 "no help on 'runn'; did you mean 'run'?" help runn
refuses 2 "completion for which shell? Not 'fish'; there are bash, zsh" completion fish
run help
cp "$work/out" "$work/help"
run --help
check "help is --help" cmp "$work/out" "$work/help"
for word in $("$program" completion bash | sed -n "s/^        '') words='\(.*\) --set.*/\1/p"); do
    run help "$word"
    check "help $word: usage and examples in 80 columns" eval '[ $status -eq 0 ] && grep -q "^usage: lagrangia $word" "$work/out" && grep -q "^examples:" "$work/out" && [ -z "$(awk "length(\$0) > 80" "$work/out")" ]'
done
for words in "run pendulum --output $work/o" "run pendlum" check list; do
    run $words
    sed -E 's/[0-9.]+ s$//' "$work/out" >"$work/plain"
    NO_COLOR=1 run $words
    check "$words: NO_COLOR or not, no colours" eval 'sed -E "s/[0-9.]+ s$//" "$work/out" | cmp - "$work/plain" && ! grep -q "$(printf "\033")" "$work/out" "$work/err"'
done

# A changed scene is another one
run run pendulum --output "$work/changed"
cp "$work/changed/pendulum.dat" "$work/shipped.dat"
run run pendulum --set pendulum%l=2 --set scene%dt=1e-2 --output "$work/changed"
cp "$work/out" "$work/text"
check "changed: not judged, and it says so" eval '[ $status -eq 0 ] && grep -q "^pendulum .* -$" "$work/out" && grep -q "changed by --set" "$work/out"'
check "changed: another title" eval 'grep -q "dt=1e-2)$" "$work/out" && head -n 1 "$work/changed/pendulum_l_2_dt_1e-2.dat" | grep -q "(l=2, dt=1e-2)$"'
check "changed: the unchanged scene's files are as they were" cmp "$work/shipped.dat" "$work/changed/pendulum.dat"
run run pendulum --set pendulum%l=2 --set scene%dt=1e-2 --json --output "$work/changed"
check "changed: the same in JSON" json 'd[0]["changes"] == "l=2, dt=1e-2" and d[0]["verdict"] == "not judged" and d[0]["file"].endswith("/pendulum_l_2_dt_1e-2.dat")'
check "changed: the rows are the JSON's" python3 .ci/scorecard_text.py "$work/text" "$work/out" all
run run pendulum --set pendulum%l=2 --set scene%expect_error=1e-30 --output "$work/changed"
check "changed: judged by what is set with it" eval '[ $status -eq 1 ] && grep -q "NOT as expected: error" "$work/out"'

# compare and --overlay: several runs in one picture
run compare pendulum --methods verlet,rk4,dop853 --output "$work/cmp"
check "compare: a row a method, one script for all files" eval '[ $status -eq 0 ] && [ "$(grep -c "^  \(verlet\|rk4\|dop853\), " "$work/out")" -eq 3 ] && grep -q "data3 = folder.\"pendulum_dop853.dat\"" "$work/cmp/pendulum_methods.gp" && grep -q "title \"rk4, dt = 0.001 s\" noenhanced" "$work/cmp/pendulum_methods.gp"'
check "compare: motion, drift and error" eval '[ "$(tail -n 1 "$work/cmp/pendulum_rk4.dat" | wc -w)" -eq 4 ] && [ "$(grep -c "^plot " "$work/cmp/pendulum_methods.gp")" -eq 3 ] && [ "$(grep -c "set logscale y" "$work/cmp/pendulum_methods.gp")" -eq 2 ]'
run compare pendulum --methods verlet,rk4 --json --output "$work/cmp"
check "compare --json" json '[e["method"] for e in d] == ["verlet", "rk4"] and d[1]["error"] < 1e-9 < d[0]["error"]'
run compare pendulum --starts "1 2 0:7" --quiet --output "$work/cmp"
check "compare --starts: a phase portrait, angles within one turn" eval '[ $status -eq 0 ] && grep -q "set xrange \[-pi:pi\]" "$work/cmp/pendulum_starts.gp" && [ "$(grep "^[^#]" "$work/cmp/pendulum_start_3.dat" | head -n 1)" = " 0.0000000000000000E+000  0.0000000000000000E+000  7.0000000000000000E+000" ]'
check "compare --starts: each title says its start" eval 'head -n 1 "$work/cmp/pendulum_start_1.dat" | grep -q "pendulum from q = 1$" && head -n 1 "$work/cmp/pendulum_start_3.dat" | grep -q "pendulum from q = 0, v = 7$" && grep -q "^set label 1 .*pendulum from q = 0, v = 7" "$work/cmp/pendulum_start_3.gp"'
check "compare: the script names the files that it draws" eval '[ "$(head -n 1 "$work/cmp/pendulum_starts.gp")" = "# Draws pendulum_start_1.dat, pendulum_start_2.dat, pendulum_start_3.dat as they lie beside this script." ]'
for words in "--methods rk4,verlet" "--starts 1\ 2"; do
    eval run compare pendulum $words --set scene%output=first/try --quiet --output "$work/below"
done
check "compare: a scene's output may name a folder, the script lies there, too" eval '[ $status -eq 0 ] && [ "$(grep -h "^data.* = folder" "$work"/below/first/*_methods.gp "$work"/below/first/*_starts.gp | grep -o "\".*\"" | tr -d "\"" | while read -r name; do [ -s "$work/below/first/$name" ] && echo there; done | wc -l)" -eq 4 ]'
run compare hanging_chain --methods rk4,gauss16 --set hanging_chain%n=5 --set scene%q=5*0.1 --set scene%v=5*0 --set scene%duration=0.1 --output "$work/cmp"
check "compare: of many coordinates it says which are drawn" eval '[ $status -eq 0 ] && grep -qx "of 5 coordinates the files and the picture have the first 3" "$work/out"'
run run rolling_disk rolling_disk_incline --set "scene%columns=t,x,y,theta,phi,x_dot,y_dot,theta_dot,phi_dot" --overlay --output "$work/cmp"
check "--overlay: what the picture has no room for is said" eval '[ $status -eq 0 ] && grep -q "the picture of all runs has no room for theta_dot, phi_dot$" "$work/err"'
run run bouncing_ball --animate --output "$work/cmp"
check "--animate: the energy of a ball that bounces is not called conserved" eval '[ $status -eq 0 ] && grep -q "\"conserved\": false" "$work/cmp/bouncing_ball.html"'
run modes rotating_hoop --output "$work/cmp"
check "modes: the files are of the first equilibrium" eval '[ $status -eq 0 ] && grep -qx "files are of the first equilibrium; those of the other: --at 1.1675569038050428" "$work/out"'
run modes rotating_hoop --at 1.1675569038050428 --output "$work/cmp"
check "modes: those of the other, with omega^2 in a few digits and its unit" eval '[ $status -eq 0 ] && grep -q "mode 1: .*^{2} = 21.1506 s^{-2}\"" "$work/cmp/rotating_hoop_at_1.1675569038050428_mode_1.gp"'
run modes hanging_chain --set hanging_chain%n=13 --output "$work/cmp"
check "modes: a picture of twelve says of how many" eval '[ $status -eq 0 ] && grep -qx "the picture has the first 12 of 13 modes" "$work/out" && grep -qx "# the first 12 of 13 modes" "$work/cmp/hanging_chain_n_13_modes.dat"'
for words in modes check describe derive; do
    run help $words
    check "help $words: it takes a scene of your own" grep -qx "  a scene of your own      the path of a .nml file" "$work/out"
done
run sweep pendulum --over theta=1:2:2 --keep "first theta_dot = -0.1250000000000001 falling" --json --output "$work/cmp"
check "sweep --json: a count is a number" json 'd["kept"][0]["found"] == 2'
check "sweep: the whole name of what is kept" eval 'grep -qx "# theta\[rad\] first_theta_dot=-0.1250000000000001_falling\[s\]" "$work/cmp/pendulum_sweep.dat"'
run sweep section --over theta2_dot=0:1:2 --set sweep%points=2 --output "$work/cmp"
check "sweep: a title of the scene counts no motions" eval '[ $status -eq 0 ] && ! grep -qi twenty "$work"/cmp/section*sweep.gp'
for dt in 0.2 0.3; do run compare pendulum --methods rk4,verlet --animate --set scene%dt=$dt --output "$work/cmp"; done
check "compare --animate: two methods in one film, files of each change" eval '[ $status -eq 0 ] && grep -q "\"reference\": \"verlet\"" "$work/cmp/pendulum_dt_0.2_methods.html" && [ "$(wc -c <"$work/cmp/pendulum_dt_0.3_methods.html")" -lt 300000 ] && grep -q "^film: .*pendulum_dt_0.3_methods.html" "$work/out"'
refuses 2 "--animate: a film shows two methods, not 3" compare pendulum --methods rk4,verlet,dop853 --animate --output "$work/none"
refuses 2 "--animate: a film shows two methods of one motion" compare pendulum --starts "1 2" --animate --output "$work/none"
mkdir -p "$work/named/pendulum_methods.html"
run compare pendulum --methods rk4,verlet --output "$work/named"
check "compare without --animate: what its film would be called does not matter" [ $status -eq 0 ]
run run pendulum cart_pendulum --overlay --quiet --output "$work/cmp"
check "run --overlay: the columns that both have" eval '[ $status -eq 0 ] && [ "$(grep -c "^plot " "$work/cmp/overlay.gp")" -eq 2 ] && grep -q "data2 = folder.\"cart_pendulum.dat\"" "$work/cmp/overlay.gp"'
refuses 2 "compare what?" compare
refuses 2 "compare by what? --methods rk4,verlet or --starts" compare pendulum
refuses 2 "compare by what?" compare pendulum --methods rk4,verlet --starts "1 2"
refuses 2 "unknown method 'rk5'" compare pendulum --methods rk4,rk5 --output "$work/none"
refuses 2 "'boris': boris is for charges in magnetic fields" compare pendulum --methods rk4,boris --output "$work/none"
refuses 2 "'verlet': verlet is for forces that depend on positions only" compare double_pendulum --methods rk4,verlet --output "$work/none"
refuses 2 "--methods: 'rk4' is given twice" compare pendulum --methods rk4,rk4 --output "$work/none"
refuses 2 "--methods: two at least are needed" compare pendulum --methods rk4 --output "$work/none"
refuses 2 "start 'x': " compare pendulum --starts "1 x" --output "$work/none"
refuses 2 "unknown method ''" compare pendulum --methods rk4,,verlet --output "$work/none"
run compare pendulum --starts "1  2" --quiet --output "$work/doubled"
check "compare: blanks between two starts count once" eval '[ $status -eq 0 ] && [ "$(ls "$work/doubled" | grep -c "dat$")" = 2 ]'
refuses 2 "start '-1': violates the constraint" compare bouncing_ball --starts "-1 2" --output "$work/none"
rm -f "$work/not_again"
for scene in pendulum kepler double_pendulum skate pendulum_turning; do
    run compare $scene --methods rk4,dop853 --format csv --quiet --output "$work/again/csv"
    [ "$status" -eq 0 ] || echo "$scene" >>"$work/not_again"
    run compare $scene --methods rk4,dop853 --quiet --output "$work/again"
    for method in rk4 dop853; do
        sed -n "s/^# //p" "$work/again/${scene}_$method.dat" | sed -n "/^ *&/,/^ *\/$/p" >"$work/again/${scene}_$method.nml"
        for file in "$work/again/csv/${scene}_$method.csv.nml" "$work/again/${scene}_$method.nml"; do
            run run "$file" --quiet --output "$work/again/again"
            [ "$status" -eq 0 ] && cmp -s <(grep -v "^#" "$work/again/${scene}_$method.dat") <(grep -v "^#" "$work/again/again/${scene}_$method.dat") || echo "$file" >>"$work/not_again"
        done
    done
done
check "compare: what it writes can be run again, and gives the same rows" [ ! -e "$work/not_again" ]
run compare bouncing_ball --methods rk4,gauss16 --json --output "$work/again"
check "compare: energy that impacts take is no drift, and the error is that beside the closed form" json 'all(e["error"] < 1e-12 and not any("energy" in k for k in e.get("drifts", {})) for e in d)'
run compare pendulum --methods dop853,gauss16 --set scene%tolerance=1e-8 --output "$work/again"
check "compare: a tolerance for methods that the scene's own is not one of" eval '[ $status -eq 0 ] && [ "$(grep -c "tolerance 1e-8 " "$work/out")" -eq 2 ]'
run compare pendulum_turning --methods rk4,verlet --set scene%dt=0.01 --output "$work/again"
check "compare: a step where the scene has a tolerance" eval '[ $status -eq 0 ] && [ "$(grep -c "dt = 0.01 s " "$work/out")" -eq 2 ]'
run compare pendulum --methods rk4,dop853 --set scene%tolerance=1e-8 --set scene%dt=0.01 --output "$work/again"
check "compare: each method takes of a step and a tolerance what it can" eval '[ $status -eq 0 ] && grep -q "rk4, dt = 0.01 s" "$work/out" && grep -q "dop853, tolerance 1e-8" "$work/out"'
refuses 2 "method 'rk4' takes steps of dt" compare pendulum --methods rk4,verlet --set scene%tolerance=1e-8 --output "$work/none"
run compare double_pendulum_section --methods rk4,gauss16 --output "$work/again"
check "compare: samples far apart are no steps" eval '[ $status -eq 0 ] && grep -q "rk4, dt = 0.01 s" "$work/out"'
refuses 2 "unknown picture format 'bmp'; there are png, svg, pdf" compare pendulum --methods rk4,verlet --plot=bmp --output "$work/none"
refuses 2 "--overlay: two scenes at least are needed" run pendulum --overlay --output "$work/none"
refuses 2 "are one file" run pendulum cart_pendulum --overlay --set scene%output=overlay --output "$work/none"
"$program" show pendulum >"$work/over.nml"
sed -i "s/&scene/\&scene output = 'overlay'/" "$work/over.nml"
refuses 2 "the overlay script '$work/none/overlay.gp' and the data script" run "$work/over.nml" cart_pendulum --overlay --output "$work/none"
check "compare, --overlay: what is refused leaves no file" [ ! -e "$work/none" ]
run modes double_pendulum --quiet --output "$work/cmp"
check "modes --output: the mechanism, two rods and two masses a side" eval '[ $status -eq 0 ] && [ "$(awk "!/#/ && \$1 == 2 && \$2 == 1 && \$3 == 1" "$work/cmp/double_pendulum_modes.dat" | wc -l)" -eq 2 ] && [ "$(awk "!/#/ && \$1 == 2 && \$2 == 1 && \$3 == 0" "$work/cmp/double_pendulum_modes.dat" | wc -l)" -eq 2 ] && [ "$(grep -c "^set title \"" "$work/cmp/double_pendulum_modes.gp")" -eq 2 ]'

# A file that cannot be written, whichever of a command's it is: one line with its name, and no other
blocked() { # blocked WORDS...: each file in turn is a folder
    local name words=$*
    rm -rf "$work/free"
    run "$@" --output "$work/free"
    check "$words: files" eval '[ $status -eq 0 ] && [ -n "$(ls "$work/free")" ]'
    for name in $(ls "$work/free" | grep -v svg); do # a report goes without its pictures
        rm -rf "$work/taken"
        mkdir -p "$work/taken/$name"
        run "$@" --output "$work/taken"
        check "$words: $name is a folder" eval '[ $status -eq 5 ] && [ "$(grep -c "cannot write .*$name.: it is a folder$" "$work/err")" -eq 1 ] && leftovers'
    done
}
blocked run bouncing_ball --animate
blocked run bouncing_ball --format npy
blocked run pendulum oscillator --overlay
blocked compare pendulum --methods rk4,verlet
blocked compare pendulum --starts "1 2"
blocked modes cart_pendulum --animate
blocked modes pendulum
blocked sweep flip_map --over theta1=0.5:3:3
blocked sweep flip_map --over theta1=0.5:3:3 --format csv
blocked report pendulum
for principle in action constraints least-time; do blocked principle $principle; done
blocked bench precision --quick --problems P1 --methods rk4,gauss16

# --quiet: not a word, whichever command; --json: JSON and nothing else, but remarks on stderr
for words in "--output $work/q" "run pendulum --output $work/q" "compare pendulum --methods rk4,verlet --output $work/q" "report pendulum --output $work/q" \
    "modes pendulum --output $work/q" "bench output --quick" "stress elastic" "grade data/homework/right.txt" "sweep flip_map --over theta1=0.5:3:3 --output $work/q"; do
    run $words --quiet
    check "$words --quiet: not a word" eval '[ $status -eq 0 ] && [ ! -s "$work/out" ] && [ ! -s "$work/err" ]'
    [ "${words%% *}" = report ] && continue
    run $words --json
    check "$words --json: JSON, not empty" json 'len(d) > 0'
done
run grade data/homework/wedge.txt --quiet
check "grade --quiet: one line and the status say that something is wrong" eval '[ $status -eq 1 ] && [ ! -s "$work/out" ] && one_line'
for words in "check pendulum" "errata" "errata E9" "principle gauge" "derive pendulum" "modes pendulum"; do
    run $words --json
    check "$words --json: JSON, not empty" json 'len(d) > 0'
done

# run, its options
run run cart_pendulum pendulum --output "$work/a b'c"
check "run: two scenes, a folder with blank and quote" eval '[ $status -eq 0 ] && [ -s "$work/a b'"'"'c/pendulum.dat" ]'
run run data/scenes/pendulum_separatrix.nml --output "$work/o" --set scene%plot=theta --set scene%duration=1 --set 'scene%output=my swing' --set scene%columns="'t','theta'" --set pendulum%l=2
check "--set: scene, output with a blank, list, parameter" eval '[ $status -eq 0 ] && [ "$(grep -vc "^#" "$work/o/my swing.dat")" -eq 101 ] && grep -q "^#   l = 2.0$" "$work/o/my swing.dat"'
check "text: the last header line names columns and units" eval '[ "$(grep "^#" "$work/o/my swing.dat" | tail -n 1)" = "# t[s] theta[rad]" ]'
check "text: no time, date or place of the build" eval '! grep -E "20[0-9][0-9]-|[0-9]:[0-9]{2}:|$PWD|$HOME/" "$work/o/my swing.dat"'
run run pendulum --format csv --output "$work/o"
check "csv: a head and commas" eval '[ "$(head -n 1 "$work/o/pendulum.csv")" = "t,theta,energy_drift,error" ]'
run run pendulum --format npy --output "$work/o"
check "npy: NumPy's mark" eval '[ "$(head -c 6 "$work/o/pendulum.npy" | tail -c 5)" = NUMPY ]'
run run pendulum --quiet --output "$work/o"
check "--quiet: not a word" eval '[ $status -eq 0 ] && [ ! -s "$work/out" ] && [ ! -s "$work/err" ]'
"$program" run pendulum --json --output "$work/o" >"$work/out" 2>"$work/err" <&-
status=$?  # the scene's file is then descriptor 0
check "stdin closed: the scene is read" json 'd[0]["scene"] == "pendulum"'
run run cart_pendulum atwood --json --output "$work/o"
check "--json: the fields that were promised" json '[r["scene"] for r in d] == ["cart_pendulum", "atwood"] and all(list(r) == "scene system method t q v steps evaluations energy_drift drifts error error_from period period_error small_period_error omega omega_error state seconds title changes exact_period small_period omega_formula choice warning remark failure verdict file events".split() for r in d)'
check "--json: final state" json 'd[0]["t"] == 20 and len(d[0]["q"]) == 2 and abs(d[1]["q"][0] - 1.962*2) < 1e-12 and d[1]["error"] < 1e-13'
run run rotating_hoop_rest driven_pendulum --json --output "$work/o"
check "--json: null for what is not known" json 'd[0]["period"] is None and d[0]["energy_drift"] is None and d[1]["energy_drift"] is None and d[1]["error"] > 0'
printf '%s\n' "&scene title='it''s \`touch $work/owned\` \$(touch $work/owned) \"; \\' system='pendulum' dt=1e-2 duration=1 q=1 /" >"$work/it's a swing.nml"
run run "$work/it's a swing.nml" --set scene%output=swing --output "$work/o"
check "a scene with blanks and a quote in its name" [ "$status" -eq 0 ]
run run pendulum sphere --animate --output "$work/film"
check "--animate: a page a scene, less than 300 kB, whole" eval '[ $status -eq 0 ] && for f in pendulum sphere; do [ "$(tail -n 1 "$work/film/$f.html")" = "</html>" ] && [ "$(wc -c <"$work/film/$f.html")" -lt 300000 ] || exit 1; done'
check "--animate: the data as without" eval 'cmp "$work/film/pendulum.dat" "$work/all/pendulum.dat"'
cp "$work/film/pendulum.html" "$work/first.html"
run run pendulum --animate --quiet --output "$work/film"
check "--animate: the same bytes again" cmp "$work/film/pendulum.html" "$work/first.html"
run modes hanging_chain --animate --quiet --output "$work/film"
check "modes --animate: one page" eval '[ $status -eq 0 ] && grep -q "mode 3" "$work/film/hanging_chain_modes.html"'
sed "s/output = .*//; s/title = .*/title = '<\/script><b>', output = 'pendulum.html'/" data/scenes/pendulum.nml >"$work/page.nml"
refuses 2 "pendulum.html" run pendulum "$work/page.nml" --animate --output "$work/film"
run run "$work/page.nml" --set scene%output=page --animate --quiet --output "$work/film"
check "--animate: a title ends no script" eval '[ $status -eq 0 ] && ! grep -q "</script><b>" "$work/film/page.html" && grep -q "&lt;/script&gt;&lt;b&gt;" "$work/film/page.html"'
run run pendulum_slack --animate --quiet --output "$work/film"
check "--animate: the symbols of a title" eval '[ $status -eq 0 ] && [ "$(grep -c "v₀² = 3.5 g l, at θ = 120 degrees" "$work/film/pendulum_slack.html")" -eq 3 ]'
run run hanging_chain --set "hanging_chain%n=1000" --set "scene%q=1000*0.1" --set scene%columns=t --set scene%plot=t --set scene%duration=1e-3 --animate --quiet --output "$work/film"
check "--animate: too many parts for a page" eval '[ $status -eq 2 ] && one_line && grep -q "no film of so many moving parts" "$work/err"'
mkdir -p "$work/film/taken/pendulum.html"
refuses 5 "it is a folder" run pendulum --animate --output "$work/film/taken"
check "--animate: that is known before the run" [ ! -e "$work/film/taken/pendulum.dat" ]
run report pendulum cart_pendulum sphere --output "$work/film"
check "report: a page" eval '[ $status -eq 0 ] && grep -q "report: $work/film/report.html" "$work/out" && [ "$(tail -n 1 "$work/film/report.html")" = "</html>" ]'
check "report: scorecard, films, derivation, errata" eval 'for text in "<h2>Scorecard</h2>" "<h3>Derivation</h3>" "<h3>Slips in the notes</h3>" "E1, lecture: cart-pendulum" "x_bob = x + l sin(theta)" "as of <a href="; do grep -qF "$text" "$work/film/report.html" || exit 1; done; [ "$(grep -c "class=.film-data" "$work/film/report.html")" -ge 3 ]'
if command -v gnuplot >/dev/null; then
    check "report: pictures" [ "$(grep -c '<svg role=.img' "$work/film/report.html")" -ge 3 ]
fi
run report .ci/inputs/diverges.nml sphere --output "$work/film"
check "report: a scene whose run fails says why, and the next one stands" eval '[ $status -eq 3 ] && grep -q "<p>the state is not finite at t = .*diverges.dat.partial" "$work/film/report.html" && grep -q "^sphere .* holds$" "$work/film/report.html"'
(PATH=$work; exec "$program" report pendulum --quiet --output "$work/film") >"$work/out" 2>"$work/err"
status=$?
check "report: without gnuplot it says so" eval '[ $status -eq 0 ] && grep -q "no picture: .*gnuplot" "$work/film/report.html"'
sed "s/output = .*//; s/title = .*/title = 'x', output = 'report.html'/" data/scenes/pendulum.nml >"$work/page.nml"
refuses 2 "report" report "$work/page.nml" --output "$work/film"
if command -v gnuplot >/dev/null; then
    run run "$work/it's a swing.nml" --set scene%output=swing --output "$work/o" --plot=svg
    check "--plot: a picture" eval '[ $status -eq 0 ] && grep -q "</svg>" "$work/o/swing.svg"'
    check "--plot: a title is no command" [ ! -e "$work/owned" ]
    for words in "principle least-time" "compare pendulum --methods rk4,verlet" "modes double_pendulum" "sweep flip_map --over theta1=0.5:3:3" \
        "bench precision --quick --problems P1 --methods rk4"; do
        run $words --plot=svg --output "$work/pictures/${words%% *}"
        check "$words --plot=svg: a picture" eval '[ $status -eq 0 ] && grep -q "</svg>" "$work/pictures/${words%% *}"/*.svg'
    done
fi

# words about
run --help
check "--help" eval '[ $status -eq 0 ] && grep -q "^usage: lagrangia" "$work/out" && [ ! -s "$work/err" ]'
run run --help
check "run --help" eval '[ $status -eq 0 ] && grep -q "^usage: lagrangia run SCENE" "$work/out"'
run --version
check "--version: version, compiler, build" eval '[ $status -eq 0 ] && grep -qE "^lagrangia [0-9.]+$" "$work/out" && grep -qE "GCC version .*optimised$" "$work/out"'
check "--version: that of fpm.toml, of the newest section of the changelog and of the manual" eval '[ "$(head -n 1 "$work/out")" = "lagrangia $(sed -n "s/^version = \"\(.*\)\"/\1/p" "fpm.toml")" ] && [ "$(sed -n "s/^## \([0-9.]*\),.*/lagrangia \1/p" "CHANGELOG.md" | head -n 1)" = "$(head -n 1 "$work/out")" ] && "$program" manual | grep -qF "$(head -n 1 "$work/out")"'
if [ "$(uname -m)" = x86_64 ]; then # FMA4 was in AMD's processors of 2011 to 2015 only
    echo 'int main(void) { return 0; }' >"$work/main.c"
    gcc -mfma4 src/core/processor.c "$work/main.c" -o "$work/foreign" && "$work/foreign" 2>"$work/err" >"$work/out"
    status=$?
    check "a build for another processor says so" eval '[ $status -eq 4 ] && one_line && grep -q "needs a processor with FMA4; build it again on this one: rm -rf build; fpm run" "$work/err"'
fi
run list
check "list" eval '[ $status -eq 0 ] && grep -q "^systems$" "$work/out" && grep -q "^methods$" "$work/out" && grep -q "^scenes$" "$work/out"'
run list scenes
check "list scenes: one a line" eval '[ "$(wc -l <"$work/out")" -eq "$scenes" ]'
systems=$("$program" list systems | cut -d' ' -f1)
for system in $systems; do
    run describe "$system"
    [ "$status" -eq 0 ] && grep -q '^L =$' "$work/out" || { check "describe $system" false; }
done
check "describe: every system of the list" [ "$(wc -w <<<"$systems")" -eq 13 ]
run describe atwood
check "describe atwood: no lift, no pulley, short" grep -q '^  (m1 + m2)/2 x_dot^2 + (m1 - m2) g x$' "$work/out"
run describe atwood_lift
check "describe: a scene's parameters" grep -q 'default 0.0; any finite number' "$work/out"
check "describe: what holds for them" grep -q 'a_s t x_dot' "$work/out"
run describe atwood --set atwood%pulley_inertia=0.02
check "describe: --set" grep -q '^  (m1 + m2 + I/R^2) x_ddot = (m1 - m2) g$' "$work/out"
refuses 2 "unknown key 'n'" describe oscillator --set oscillator%n=1
run describe hanging_chain
check "describe: a whole number" grep -q 'default 3;' "$work/out"

# Small oscillations, the audit, the principles
for moment in 1e9 3e9 1e10; do
    run check symmetric_top --set "symmetric_top%I3=$moment"
    check "check: a top of I3 = $moment kg m^2, what leaves no digit is not judged" eval '[ $status -eq 0 ] && grep -q "is not judged there" "$work/out"'
done
run modes cart_pendulum
check "modes: a zero mode that is 0 has no bound" eval 'grep -q "zero mode$" "$work/out"'
run modes cart_pendulum --set cart_pendulum%m1=2 --set cart_pendulum%m2=0.5 --set cart_pendulum%l=1.3 --json
check "modes: a zero mode and (m1 + m2) g/(m1 l)" json 'd["omega2"][0] == 0 and d["label"][0] == "zero mode" and abs(d["omega2"][1]/(2.5*9.81/(2*1.3)) - 1) < 1e-14'
run modes rotating_hoop --set rotating_hoop%r=0.5 --set rotating_hoop%omega=7 --json
check "modes rotating_hoop: the bottom, unstable, and cos(theta*) = g/(omega^2 r)" json 'd["label"] == ["unstable"] and (lambda e: abs(e["at"][0] - __import__("math").acos(9.81/24.5)) < 1e-15 and abs(e["omega2"][0] - (49 - (9.81/3.5)**2)) < 1e-12 and e["label"] == ["oscillation"])(d["elsewhere"])'
run modes rotating_hoop --set rotating_hoop%r=0.5 --set rotating_hoop%omega=7
check "modes rotating_hoop: both in words" eval '[ $(grep -c "small oscillations about theta = " "$work/out") = 2 ]'
run modes rotating_hoop --set rotating_hoop%r=0.5 --set rotating_hoop%omega=4 --json
check "modes rotating_hoop, turned slowly: the bottom alone" json 'd["at"] == [0.0] and d["label"] == ["oscillation"] and "elsewhere" not in d'
run modes rotating_hoop --set rotating_hoop%r=0.5 --set rotating_hoop%omega=7 --at 0 --json
check "modes rotating_hoop --at 0: what was asked for" json 'd["at"] == [0.0] and "elsewhere" not in d'
for name in $("$program" list systems 2>/dev/null | awk '{print $1}'); do
    run describe "$name"
    case $name in
        double_pendulum|hanging_chain) check "describe $name: no closed form" grep -q '^  gauss16; the program has no closed form of it$' "$work/out" ;;
        bouncing_ball) check "describe $name: auto looks for impacts" grep -q '^  gauss16, for impacts are looked for between its steps$' "$work/out" ;;
        *) check "describe $name: a closed form" grep -q '^  a closed form where one is known' "$work/out" ;;
    esac
done
run modes oscillator --set oscillator%m=1 --set oscillator%k=25 --set oscillator%b=6 --json
check "modes --json: a damped oscillator decays at 3 and turns at 4" json 'abs(d["damped"]["decay_rate"][0] - 3) < 1e-12 and abs(d["damped"]["omega"][0] - 4) < 1e-12'

modes_are() { # modes_are WORDS...: the text of `modes` against its --json
    run modes "$@"
    cp "$work/out" "$work/text"
    run modes "$@" --json
    check "modes $*: the text is the JSON's, and solves the equation" python3 .ci/modes_text.py "$work/text" "$work/out"
}
modes_are double_pendulum
modes_are cart_pendulum --set cart_pendulum%m1=2 --set cart_pendulum%l=1.3
modes_are hanging_chain --set hanging_chain%n=3
modes_are rotating_hoop --set rotating_hoop%r=0.5 --set rotating_hoop%omega=7 --at 0
modes_are charged_particle --set charged_particle%trap=3 --set charged_particle%magnetic=0,0,2
run modes hanging_chain --set hanging_chain%n=200 --output "$work/modes"
check "modes: a long chain, a file and a script a mode, and all as the mechanism" eval '[ $status -eq 0 ] && [ "$(ls "$work/modes" | wc -l)" -eq 402 ]'
refuses 2 "the nearest is 0.0" modes pendulum --at 1
run modes pendulum --at -0
check "modes: zero has no sign" eval '[ $status -eq 0 ] && grep -q "theta = 0.0$" "$work/out"'
refuses 2 "has 2 values, not 1" modes double_pendulum --at 0
refuses 2 "greater than 0.0 is needed" modes cart_pendulum --set cart_pendulum%m1=0
refuses 4 "other units are needed" modes pendulum --set pendulum%g=1e308 --set pendulum%l=1e-300
run check pendulum rolling_disk --json
check "check: every claim holds" json 'len(d) == 78 and all(row["holds"] for row in d)'
check "check: no word of time where it takes none" [ ! -s "$work/err" ]
cp "$work/out" "$work/rows"
run check pendulum rolling_disk
check "check: the text's remarks are the JSON's" python3 -c 'import json, sys
remarks = [row["remark"] for row in json.load(open(sys.argv[2])) if row["remark"]]
lines = [line[6:] for line in open(sys.argv[1]).read().splitlines() if line[:6] == " "*6]
assert remarks and lines == remarks, (lines, remarks)' "$work/out" "$work/rows"
run principle virtual-work --json
check "principle: its controls fail, the rest holds" json 'all(row["holds"] != row["control"] for row in d) and any(row["control"] for row in d)'
cp "$work/out" "$work/rows"
run principle virtual-work
check "principle: the text's differences and bounds are the JSON's" python3 -c 'import json, sys
lines = open(sys.argv[1]).read().splitlines()
for row in json.load(open(sys.argv[2])):
    words = [line[46:].split() for line in lines if line[:46].strip() == row["statement"]]
    near = lambda word, value: abs(float(word) - value) <= 0.06*abs(value)
    assert any(near(w[2], row["difference"]) and near(w[3], row["bound"]) for w in words if len(w) > 4), row' "$work/out" "$work/rows"
run run cart_pendulum_small --output "$work/o"
check "a period stands beside 2 pi/omega" grep -q "^            1.6379465859 s      2 pi/omega of small swings; off by 1.9e-7 of it$" "$work/out"
check "what no scene has stated is not explained" eval '! grep -q "give or take" "$work/out"'
run run pendulum oscillator --error-estimate --output "$work/o"
check "two scenes state their ends, and what brackets mean is said once" eval '[ "$(grep -c "^    at the end: " "$work/out")" -eq 2 ] && [ "$(grep -c "give or take" "$work/out")" -eq 1 ] && ! grep -q "^small:" "$work/out"'
cat >"$work/thin.nml" <<'END'
&scene system='wall', method='dop853', tolerance=6e-12, duration=6.3, samples=5, q=0.04, v=1.08 /
&lagrangian coordinates='x [m]', T='x_dot^2/2', V='6 exp(-((x^2 - 1.09)/2.7e-7)^2)' /
END
run run "$work/thin.nml" --error-estimate --output "$work/o"
check "run --error-estimate: walls so thin that their place is rounded leave some digits" eval '[ $status -eq 0 ] && grep -q "at the end: x = -0\.[0-9]*([0-9]) m, x_dot = -1\.0[0-9]*([0-9]) m/s" "$work/out"'
run run cart_pendulum_small --json --set cart_pendulum%g=981 --output "$work/o"
check "a period far below a second is beside 2 pi/omega" json '0 < d[0]["small_period_error"] < 1e-6'
run run pendulum --json --set pendulum%g=981 --output "$work/o"
check "and beside the exact one" json '0 < d[0]["period_error"] < 1e-6'
run run cart_pendulum --output "$work/o"
check "and beside the exact one" grep -q "^            [0-9.]* s      exact; they differ by [0-9.]*e-1[0-9] of it$" "$work/out"
for page in $("$program" principle | cut -d' ' -f1); do
    run principle "$page" --json --output "$work/o"
    json 'len(d) > 5 and all(row["holds"] != row["control"] for row in d) and any(row["control"] for row in d)' || check "principle $page: its controls differ, the rest holds" false
done
check "principle: eighteen pages, one a line" [ "$("$program" principle | wc -l)" -eq 18 ]
run course --json
check "course: a command or a reason for every statement" json 'len(d) == 78 and all(bool(s["shows"]) != bool(s["nothing"]) for s in d)'
refuses 2 "there are I, of 1 September 2011, and II" course III
course=$("$program" course | sed -n 's/^ *lagrangia //p' | grep -v '^check$' | sort -u)
while read -r words; do
    case $words in run* | sweep*) words+=" --quiet --output $work/o" ;; principle*) words+=" --output $work/o" ;; esac
    run $words
    [ "$status" -eq 0 ] || { [ "$words" = "grade wedge" ] && [ "$status" -eq 1 ]; } || check "course: lagrangia $words" false
done <<<"$course"
check "course: its commands run" [ "$(wc -l <<<"$course")" -gt 50 ]
run errata --json
check "errata: three parts, and what is no slip" json '[sum(slip["kind"] == kind for slip in d) for kind in ("lecture", "scan", "terminology", "no slip")] == [9, 20, 2, 1]'
check "errata: each quoted, with its line" json 'len(d) == 32 and all(q["line"] > 0 and q["scan"] in ("I", "II") and q["text"] for slip in d for q in slip["quotes"]) and all(slip["quotes"] for slip in d)'
run errata
check "errata: the parts, as text" eval 'grep -q "^slips of the lecture: 9$" "$work/out" && grep -q "^errors of the scan: .*: 20$" "$work/out" && grep -q "^terminology: .*: 2$" "$work/out"'

# bench: every part comes to its end, with the rows that belong there
methods=$("$program" list methods | wc -l) # less boris, which wants a charge, and three without a step
run bench energy --quick --json --output "$work/bench"
check "bench energy: every method for one degree of freedom, and their energies, in some seconds" json '(lambda e: len({r["method"] for r in e}) == '"$((methods - 4))"' and all(0 < r["energy_error"] < 0.02 and 0 < r["seconds"] < 60 and r["steps"] == 20000 for r in e) and [r["energy_error"] < 1e-12 for r in e if r["method"] == "gauss16"] == [True])([r for r in d if r["table"] == "energy"])'
run bench energy steps --quick --json --methods gauss16,rk4 --output "$work/bench"
check "bench: of the methods asked for alone" json 'all({r["method"] for r in d if r["table"] == t} == {"rk4", "gauss16"} for t in ("energy", "step_ns"))'
run bench precision --quick --json --problems P1 --methods rk4,gauss16,gsl_rk4 --output "$work/bench"
check "bench precision: points and times of the methods asked for" json 'all({r["method"] for r in d if r["table"] == t} == {"rk4", "gauss16", "gsl_rk4"} for t in ("work_precision", "time_to_error"))'

# Every key of a scene
# Many trajectories: numbers that are known, a picture of each kind, the same file by any number of processes
for sweep in flip_map period_of_amplitude; do
    run sweep $sweep --over theta$([ $sweep = flip_map ] && echo 1)=0.5:3:200 --set scene%output=$sweep --output "$work/sweep" --plot --threads 1
    check "sweep $sweep: a table and a picture" eval '[ $status -eq 0 ] && [ ! -s "$work/err" ] && [ -s "$work/sweep/${sweep}_sweep.png" ] &&
        [ "$(grep -vc "^#" "$work/sweep/${sweep}_sweep.dat")" -eq 200 ]'
    cp "$work/sweep/${sweep}_sweep.dat" "$work/one"
    run sweep $sweep --over theta$([ $sweep = flip_map ] && echo 1)=0.5:3:200 --set scene%output=$sweep --output "$work/sweep" --threads 3 --json
    check "sweep $sweep: the same by three processes, and JSON" eval 'cmp "$work/one" "$work/sweep/${sweep}_sweep.dat" &&
        python3 -c "import json, sys; r = json.load(open(sys.argv[1])); assert r[\"trajectories\"] == 200 and r[\"threads\"] == 3 and r[\"failed\"] == 0" "$work/out"'
done
wide=$(df -k --output=avail "$work" | awk 'END { print int(sqrt(1.3*1024*$1/83)) + 1 }') # each takes 83 bytes
run sweep pendulum --over q=0:1:$wide --over v=0:1:$wide --keep theta --output "$work/wide"
check "sweep: more than the disk holds is not begun" eval '[ $status -eq 2 ] && [ ! -e "$work/wide" ] && grep -q "GB are free in .*; .--any-size. begins all the same$" "$work/err"'
timeout 120 "$program" sweep pendulum --over q=0:1:$wide --over v=0:1:$wide --keep theta --any-size --output "$work/wide" >"$work/out" 2>"$work/err" </dev/null &
for ((i = 0; i < 500; i++)); do
    [ "$(stat -c %s "$work/wide/pendulum_sweep.dat.part" 2>/dev/null || echo 0)" -lt 9000 ] || break
    sleep 0.2
done
check "sweep: but by --any-size it is" test -e "$work/wide/pendulum_sweep.dat.part"
kill $!
wait $!
timeout 120 "$program" sweep pendulum --over q=0:1:$wide --over v=0:1:$wide --keep theta --resume --output "$work/wide" >"$work/out" 2>"$work/resumed" </dev/null &
for ((i = 0; i < 500; i++)); do
    grep -q "takes about\|are free\|part" "$work/resumed" 2>/dev/null && break
    sleep 0.2
done
check "sweep: and it goes on by --resume" grep -q "takes about" "$work/resumed"
kill $!
wait $!
rm -rf "$work/wide"
run sweep pendulum --over q=0.5:1:3 --keep theta --threads 1000 --output "$work/sweep"
check "sweep: it says how many processes there were" grep -q "^pendulum: 3 trajectories by rk4 in .* s by 1 process, in lanes$" "$work/out"
run sweep pendulum --over q=0.5:1:3 --keep period --threads 1000 --output "$work/sweep"
check "sweep: no more processes than trajectories" grep -q "^pendulum: 3 trajectories by rk4 in .* s by 3 processes$" "$work/out"
OMP_NUM_THREADS=99999999999 run sweep pendulum --over q=0.5:1:3 --keep period --output "$work/sweep"
check "sweep: no number of threads is too large" grep -q "^pendulum: 3 trajectories by rk4 in .* s by 3 processes$" "$work/out"
run sweep pendulum --over l=1e-9:1:10:log --keep theta --set scene%method="'dop853'" --set sweep%most_steps=20000 --output "$work/sweep"
check "sweep: steps are limited, and it says whose were" eval '[ $status -eq 0 ] && grep -q "^lagrangia: 6 of 10 trajectories failed and are NaN; the first: more than 20000 steps, at t = 0.0" "$work/err"'
run sweep pendulum --over l=1e-9:1:10:log --keep theta --output "$work/sweep"
check "sweep: a step that is too long at a corner" grep -q "^lagrangia: l = 1e-9: dt = 0.001 s exceeds the step limit 2.856e-5 s of rk4" "$work/err"
mkfifo "$work/sweep/duffing_sweep.dat.part"
run sweep duffing --over x=1:2:3 --keep x --output "$work/sweep"
check "sweep: a pipe in the place of its file is not waited for" eval '[ $status -eq 5 ] && grep -q "is not a file that a sweep has written$" "$work/err"'
rm "$work/sweep/duffing_sweep.dat.part"
run sweep hanging_chain --over n=2:5:4 --keep energy --output "$work/sweep"
check "sweep: where all fail, it says so" eval '[ $status -eq 2 ] && grep -q "all 4 trajectories fail: q has 10 values" "$work/err"'
mkdir -p "$work/folders/flip_map_sweep.dat"
run sweep flip_map --output "$work/folders"
check "sweep: a folder in the place of the table is seen before anything is computed" eval '[ $status -eq 5 ] && grep -q "it is a folder$" "$work/err" && [ "$(ls "$work/folders")" = flip_map_sweep.dat ]'
run sweep pendulum --over q=0.1:3:2 --over v=1:nan:2 --keep period --output "$work/sweep"
check "sweep: which axis cannot be read" eval '[ $status -eq 2 ] && grep -q "the axis v: .nan.: column 1: unknown name" "$work/err"'
check "sweep: the measured period is the exact one" awk '!/^#/ { d = $2/$3 - 1; if (d*d > 1e-18) exit 1 }' "$work/sweep/period_of_amplitude_sweep.dat"
run sweep pendulum --over q=0.5:1:2 --keep "period, max theta" --keep energy --output "$work/sweep"
check "sweep --keep: several with commas" eval '[ $status -eq 0 ] &&
    grep -q "^# .*period\[s\] *max_theta\[rad\] *energy\[J\]$" "$work/sweep/pendulum_sweep.dat"'
run sweep hanging_chain --over n=9:10:2 --keep lyapunov --set scene%duration=0.5 --output "$work/sweep"
check "sweep over the number of coordinates: it says why not" eval '[ $status -eq 0 ] &&
    grep -q "1 of 2 trajectories failed and are NaN; the first: q has 10 values; the system has 9 coordinates" "$work/err"'
run sweep pendulum --over l=0.1:10:4:log --over theta=0.1:3:3 --keep period --output "$work/sweep" --plot
check "sweep over two axes: a map" eval '[ $status -eq 0 ] && [ -s "$work/sweep/pendulum_sweep.png" ] && [ "$(grep -c "^$" "$work/sweep/pendulum_sweep.dat")" -eq 3 ]'
for row in "bifurcation f=1:1.5:3 210" "section theta2_dot=-4:4:3 1800" "basins theta=-3:3:8 8" "lyapunov_map f=1:1.5:2 2"; do
    read -r sweep over rows <<<"$row"
    run sweep $sweep --over $over --set scene%output=$sweep --output "$work/sweep" --plot
    check "sweep $sweep: $rows rows and a picture" eval '[ $status -eq 0 ] && [ ! -s "$work/err" ] && [ -s "$work/sweep/${sweep}_sweep.png" ] &&
        [ "$(grep -c "^[^#]" "$work/sweep/${sweep}_sweep.dat")" -eq $rows ]'
done
for words in "sweep bifurcation --set sweep%strobe=w0" "sweep section --set sweep%strobe='1'" "sweep section --set sweep%energy_by=x" \
    "sweep pendulum --over q=0:1:3 --keep attractor" "sweep section --set sweep%points=0" \
    "sweep" "sweep pendulum" "sweep pendulum --over q=0:1:3" "sweep pendulum --over q=0:1 --keep q" "sweep pendulum --over q=0:1:3 --keep nope" "sweep resonance --set sweep%after=300"; do
    run $words --output "$work/sweep"
    check "$words: one line, status 2" eval '[ $status -eq 2 ] && [ "$(wc -l <"$work/err")" -eq 1 ] && [ ! -s "$work/out" ]'
done
run sweep section --format npy --set sweep%points=3 --set scene%output=three --output "$work/sweep"
check "sweep: an axis and what is kept of the same name are two columns of npy" grep -aq "('theta2_dot_0', .*('wrapped_theta2', .*('theta2_dot', " "$work/sweep/three_sweep.npy"
cp "$work/sweep/three_sweep.npy" "$work/three.npy"
run sweep "$work/sweep/three_sweep.npy.nml" --format npy --set scene%output=again --output "$work/sweep"
check "sweep: beside npy lies the scene, which gives the same numbers again" cmp "$work/three.npy" "$work/sweep/again_sweep.npy"
run sweep pendulum --over theta=1:3.1:3 --keep theta --format csv --plot --output "$work/sweep"
check "sweep: an axis that is kept, too, is that of the start" eval '[ "$(head -1 "$work/sweep/pendulum_sweep.csv")" = theta_0,theta ] &&
    [ -s "$work/sweep/pendulum_sweep.csv.nml" ] && grep -q "^set xlabel \"start: " "$work/sweep/pendulum_sweep.csv.gp"'
refuses 2 "a sweep measures no error" sweep pendulum --over theta=0.5:2.5:3 --keep error --output "$work/none"
refuses 2 "'magnetic_z'; write 'magnetic(3)'" sweep charged_trap --over magnetic_z=0:1:3 --keep x --output "$work/none"
mkdir "$work/names"
for name in pend.v2 pend pend.old; do "$program" show scenes/pendulum.nml | grep -v "^ *output" >"$work/names/$name.nml"; done
run run "$work/names/pend.v2.nml" "$work/names/pend.nml" "$work/names/pend.old.nml" --quiet --output "$work/names/o"
check "run: names with dots have files of their own" eval '[ $status -eq 0 ] && [ "$(ls "$work/names/o" | tr "\n" " ")" = "pend.dat pend.gp pend.old pend.old.gp pend.v2.dat pend.v2.gp " ]'
cat >"$work/event.nml" <<'END'
&scene system = 'z', method = 'gauss16', tolerance = 1e-10, duration = 5, q = 1, v = 0, event = 'event = 0' /
&lagrangian coordinates = 'event', T = 'event_dot^2/2', V = 'event^2/2' /
END
run run "$work/event.nml" --format npy --output "$work/names" --quiet
check "run: a coordinate called event has a column of its own beside the event's number" grep -aq "('t', .*('event', .*('event_2', " "$work/names/event_events.npy"
for sign in '*' / + -; do "$program" run "$work/event.nml" --set "lagrangian%V='event^2${sign}3'" --quiet --output "$work/signs" >"$work/out" 2>"$work/err"; done
check "run: formulas that differ in a sign have files of their own" eval '[ "$(ls "$work/signs" | grep -c "dat$")" -eq 8 ]'
run describe "$work/event.nml" --set "lagrangian%V=2*event"
cp "$work/out" "$work/bare"
run describe "$work/event.nml" --set "lagrangian%V='2*event'"
check "a formula that begins with a number needs no quotes" eval 'grep -q "2 event" "$work/out" && cmp "$work/bare" "$work/out"'
refuses 2 "write '1e-3'" describe "$work/event.nml" --set "lagrangian%V=1d-3 event"
for name in derivation bench animation pendulum section; do
    run show $name
    check "show $name: by its name alone" eval '[ $status -eq 0 ] && [ -s "$work/out" ]'
done
refuses 2 "there are several of that name" show report
methods=$("$program" compare --help | tr "\n" " " | tr -s " " | grep -o "compared: [a-z0-9_, ]*" | sed "s/compared: //; s/, boris//; s/ //g")
run compare pendulum --methods "${methods%,dop853}" --output "$work/names/c"
check "compare: the methods that its help lists are taken" eval '[ $status -eq 0 ] && [[ $methods = *,dop853 && $methods != *gsl_* ]]'
for slip in $("$program" derive --help | tr "\n" " " | tr -s " " | grep -o "notes: [E0-9, ]*" | tr -d ",:a-z"); do
    run derive cart_pendulum --slip $slip
    check "derive --slip $slip: what its help lists is one of a derivation" eval '! grep -q "unknown slip\|no formula of a derivation" "$work/err"'
done
refuses 2 "two are written 'm > 0', 'm < 3'" describe "$work/event.nml" --set "lagrangian%domain='0 < m < 3'"
refuses 2 "'lagrangia list scenes' shows those of this one" run pendulum --set scene%system=double_pendulum --output "$work/none"
refuses 2 "behind '|' something is missing" describe "$work/event.nml" --set "lagrangian%V='|event|event|'"
refuses 2 "'lagrangia help run' tells of it" -- run pendulum
run sweep flip_map --keep thta2 --output "$work/sweep"
check "sweep: what the command line has is not blamed on the file" eval '[ $status -eq 2 ] && ! grep -q "&sweep" "$work/err" && grep -q thta2 "$work/err"'
mkfifo "$work/sweep/flip_map_sweep.dat.part"
run sweep flip_map --output "$work/sweep" --resume
check "sweep: a pipe in the place of what was computed is refused" eval '[ $status -eq 5 ] && grep -q "is not a file that a sweep has written" "$work/err"'
rm "$work/sweep/flip_map_sweep.dat.part"
printf '%s\n' "&scene system = 'own', method = 'gauss16', tolerance = 1e-9, duration = 1, samples = 5, q = 1 /" \
    "&lagrangian coordinates = 'x', Q_x = '-0.3 sgn(x_dot) - 0.1 sgn(x)', parameters = 'm', L = 'm/2 x_dot^2 - x^2/2' /" \
    "&own m = 1 /" >"$work/stick.nml"
run run "$work/stick.nml" --output "$work/stick"
check "run: of dry friction it says that it does not hold a body" \
    grep -qF "'sgn(x_dot)' jumps where the motion turns" "$work/err"
sed "s/Q_x = '-0.3 sgn(x_dot) /definitions = 'R = 0.3 sgn(x_dot)', Q_x = '-R /" "$work/stick.nml" >"$work/slip.nml"
run run "$work/slip.nml" --output "$work/stick"
check "run: nor where the jump stands in a definition" \
    grep -qF "'sgn(x_dot)' jumps where the motion turns" "$work/err"
sed -i 's/-0.3 sgn(x_dot) //' "$work/stick.nml"
run run "$work/stick.nml" --output "$work/stick"
check "run: and nothing of a force that jumps elsewhere" eval '! grep -q "jumps" "$work/err"'
cat >"$work/double_pendulum_chaos.nml" <<'END'
&scene
  title = 'How chaotic is a double pendulum? One exponent, from twenty starts of one energy'
  system = 'double_pendulum'
  method = 'gauss16'
  tolerance = 1e-8, duration = 400.0, samples = 100
  q = 0.0, 0.0
  v = 7.0, 0.0
/
&double_pendulum m1 = 1.0, m2 = 1.0, l1 = 1.0, l2 = 1.0, g = 9.81 /
&sweep
  over = 'theta2_dot = -4:4:20:random'
  keep = 'lyapunov', 'lyapunov error'
  energy_by = 'theta1_dot'
  after = 40.0
/
END
for tolerance in 1e-8 1e-6; do
    run sweep "$work/double_pendulum_chaos.nml" --set scene%tolerance=$tolerance --set scene%output=chaos_$tolerance --seed ${tolerance#1e-} --output "$work/sweep"
done
# Each error is from 16 windows of time: z is Student's t of 15, whose rms over 40 is 1.07 +- 0.13 (four of these are
# allowed), and of 40 the largest is beyond 6 once in 1000.
check "sweep: twenty starts at either of two tolerances agree about the double pendulum's exponent, as far as their errors say" python3 -c 'import sys
rows = [[float(x) for x in line.split()] for name in sys.argv[1:] for line in open(name) if line[:1] not in "#\n"]
mean = sum(r[1]/r[2]**2 for r in rows)/sum(1/r[2]**2 for r in rows)
z = [(r[1] - mean)/r[2] for r in rows]
sys.exit(not (len(rows) == 40 and abs(mean - 1.446) < 0.03 and max(map(abs, z)) < 6 and 0.53 < (sum(x*x for x in z)/39)**0.5 < 1.61))' "$work/sweep/chaos_1e-8_sweep.dat" "$work/sweep/chaos_1e-6_sweep.dat"
run sweep ueda --over x=2:3:4 --keep lyapunov --keep "lyapunov error" --set sweep%after=1000 --set scene%duration=100000 --set scene%tolerance=1e-6 --set scene%output=ueda --output "$work/sweep"
# Sprott, Chaos and Time-Series Analysis (2003), appendix A: 0.1034; 16 starts and 24, of 1e6 s each, gave 0.10350(6) and 0.10345(6)
check "sweep: Ueda's exponent is the book's, within four of its errors, from windows in which a displacement would overflow" python3 -c 'import sys
rows = [[float(x) for x in line.split()] for line in open(sys.argv[1]) if line[:1] not in "#\n"]
mean = sum(r[1] for r in rows)/4
error = sum(r[2]**2 for r in rows)**0.5/4
sys.exit(not (len(rows) == 4 and error < 8e-4 and abs(mean - 0.1034) < 4*error))' "$work/sweep/ueda_sweep.dat"
printf '%s\n' "&scene system = 'double_pendulum', tolerance = 1e-9, duration = 10, samples = 1, method = 'auto', q = 0.5, 0.8 /" >"$work/by_tolerance.nml"
run sweep "$work/by_tolerance.nml" --over theta1=0.45:0.55:40 --keep theta1 --output "$work/sweep"
check "sweep: it says that auto took dop853, in lanes" grep -q "^by_tolerance: 40 trajectories by dop853 in .* in lanes$" "$work/out"
run bench sweep --quick --json --output "$work/bench"
check "bench sweep: ours and GSL's, on one thread and on all, by rk4 to 1e-6, otherwise to 1e-9" json '(lambda r: {x["method"] for x in r} == {"rk4", "gsl_rk4", "gauss16", "dop853", "gsl_rk8pd", "lyapunov", "gsl_lyapunov"} and all(x["error"] < (1e-6 if "rk4" in x["method"] else 1e-6 if x["method"] == "gsl_lyapunov" else 1e-9) and x["us_each"] > 0 for x in r))([x for x in d if x["table"] == "sweep"])'
check "bench sweep: over_gsl is GSL's time by ours" json '(lambda r, of: len(r) > 6 and all(abs(x["over_gsl"]*x["us_each"]/next(y["us_each"] for y in r if y["threads"] == x["threads"] and y["method"] == of.get(x["method"], x["method"])) - 1) < 1e-9 for x in r))([x for x in d if x["table"] == "sweep"], {"rk4": "gsl_rk4", "gauss16": "gsl_rk8pd", "dop853": "gsl_rk8pd", "lyapunov": "gsl_lyapunov"})'
run bench output --quick --json --output "$work/bench"
check "bench output: a million rows take the time of a row, times a million" json 'len(d) == 3 and all(abs(x["rows_per_second"]*x["us_a_row"]/1e6 - 1) < 1e-12 for x in d)'
run sweep pendulum --over q=0:1:1000000 --over v=0:1:1000000 --keep theta --output "$work/sweep"
check "sweep: 1e12 trajectories are refused with their size" eval '[ $status -eq 2 ] && [ "$(wc -l <"$work/err")" -eq 1 ] && grep -q "TB on the disk and .* MB of memory, and only .* are free" "$work/err"'
run sweep pendulum --over theta=0:1:1000000000000 --keep theta --output "$work/sweep"
check "sweep: so is an axis of 1e12 values" eval '[ $status -eq 2 ] && [ "$(wc -l <"$work/err")" -eq 1 ] && grep -q "^lagrangia: 1000000000000 trajectories take up to .* TB on the disk and .* MB of memory" "$work/err"'
run describe scene
check "docs/scenes.md: what 'describe scene' prints" python3 -c 'import re, sys
sys.exit(re.search(r"```\n(.*?)```", open("docs/scenes.md").read(), re.S).group(1) != open(sys.argv[1]).read())' "$work/out"

# A student's sheet
run grade data/homework/right.txt
check "grade: a right sheet" eval '[ $status -eq 0 ] && grep -q "^8 right$" "$work/out" && [ ! -s "$work/err" ]'
run grade data/homework/wedge.txt data/homework/cart_pendulum.txt --json
check "grade --json: two sheets, the terms named" json '[sheet["wrong"] for sheet in d] == [1, 1] and [[s["remark"] for s in sheet["statements"] if s["verdict"] == "wrong"] for sheet in d] == [["\u0027M\u0027 must be \u0027m\u0027 in \u0027M (q1_ddot + q2_ddot cos(alpha))\u0027"], ["the sign of \u0027m2 g l sin(theta)\u0027"]]'
run grade data/homework/derivation.txt --json
check "grade --json: one slip in T, and seven lines that follow from it" json '[(s["line"], s["follows_from"]) for s in d[0]["statements"] if s["verdict"] in ("wrong", "follows")] == [(5, [])] + [(n, [5]) for n in range(6, 13)]'
check "docs/grading.md: commands print what it says" python3 -c 'import re, subprocess, sys
block = re.search(r"```console\n(.*?)```", open("docs/grading.md").read(), re.S).group(1)
pairs = re.findall(r"^\$ lagrangia (.*)\n((?:(?!\$ ).*\n)*)", block, re.M)
got = [subprocess.run([sys.argv[1]] + words.split(), text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE) for words, _ in pairs]
sys.exit(len(pairs) != 4 or any(g.stdout + g.stderr != text for g, (_, text) in zip(got, pairs)))' "$program"
printf 'system: pendulum\ntheta_ddot + 3\n' >"$work/sheet"
run grade "$work/sheet"
check "grade: a line without an equals sign cannot be read, with its column" eval '[ $status -eq 2 ] && grep -q "column [0-9]*: .*=" "$work/out" && grep -q "^1 unreadable" "$work/out"'
printf 'system: pendulun\ntheta_ddot = 3\n' >"$work/sheet"
refuses 2 "sheet:1: unknown system 'pendulun'; did you mean 'pendulum'?" grade "$work/sheet"
printf 'system: kepler\nset: h = 0.1\nset: m = 0\nset: k = 2\nL_z = const\n' > "$work/sheet"
run grade "$work/sheet"
check "grade: a line 'set:' that cannot be is unreadable, the others are judged" eval '[ $status -eq 2 ] && grep -A 1 "^line 3  *unreadable" "$work/out" | grep -q " m = 0: greater than 0.0 is needed" && grep -q "^line 5  *right" "$work/out"'
run grade "$work/sheet" --json
check "grade --json: that line stands among the statements" json '[(s["line"], s["verdict"]) for s in d[0]["statements"]] == [(3, "unreadable"), (5, "right")]'
printf 'system: charged_particle\ndT/dt = 0\nset: electric = 0 0 0\nset: m = 1 000\n' > "$work/sheet"
run grade "$work/sheet"
check "grade: what 'set:' fixes holds for the lines behind it" eval '[ $status -eq 2 ] && grep -q "^line 2  *wrong" "$work/out" && grep -A 1 "^line 4  *unreadable" "$work/out" | grep -q " m has 2 values; one is needed"'
printf 'system: pendulun\ntheta_ddot = 3\n' > "$work/sheet"
run grade "$work/sheet" --json
check "grade --json: JSON also where no sheet is graded" json 'd == []'
printf '%s\n' "&scene system = 'string' duration = 1.0 dt = 0.01 q = 0.1 /" "&lagrangian coordinates = 'x' parameters = 'm', 'L'" \
    "  T = 'm/2 x_dot^2' V = 'm L x^2/2' /" "&string m = 1.0 L = 2.0 /" >"$work/string.nml"
printf '%s\n' "system: $work/string.nml" "m x_ddot + m L x = 0" >"$work/sheet"
refuses 2 "string uses the letter L, which in an answer is the Lagrangian; give it another name, such as L0" grade "$work/sheet"
refuses 2 "grade what?" grade
sed "s/figure = /figure = 'let a b = l1', /" data/scenes/double_pendulum_formulas.nml >"$work/figure.nml"
refuses 2 "figure = 'let a b = l1': 'a b' is no name for a formula" run "$work/figure.nml"
refuses 5 "no such file; a sheet is a text with a line 'system: NAME' and statements, one a line" grade "$work/none.txt"
refuses 5 "atwood.txt: no such file; did you mean the sheet 'atwood'?" grade atwood.txt
ln -s loop.nml "$work/loop.nml"
for command in run grade describe; do refuses 5 "loop.nml: Too many levels of symbolic links" $command "$work/loop.nml"; done
refuses 2 "a name has no blank in it; did you mean 'virtual-work'?" principle virtual work
refuses 2 "a decimal has a point, as in 0.001" bench --tolerances 0,001
refuses 2 "without the option there is a process for each processor" sweep ueda --threads all
refuses 2 "as in --seed 4" sweep ueda --seed 1,5
refuses 2 "duration = s: units are not written" run pendulum --set "scene%duration=5 s"
refuses 2 "nothing between thousands: 1000" run pendulum --set "scene%duration=1 000"
refuses 2 "a percentage is written as a fraction" run pendulum --set "scene%duration=10%"

# Derivations: every line holds, or the command says so by its status
for system in $systems spring_pendulum double_pendulum_formulas atwood_lift; do
    run derive "$system" --numbers
    [ "$status" -eq 0 ] && [ "$(grep -c 'difference' "$work/out")" -gt 8 ] && ! grep -q ' <- ' "$work/out" || { check "derive $system" false; }
done
run derive cart_pendulum --set cart_pendulum%l=1.3 --json
check "derive --json: every line holds, omega^2 is the last" json 'd["holds"] and all(r.get("holds", True) for r in d["lines"]) and d["lines"][-1]["formula"] == "(m1 + m2) g/(m1 l)" and abs(d["lines"][-1]["value"] - 2*9.81/1.3) < 1e-13'
run derive cart_pendulum --slip E1 --json
check "derive --slip: the notes' line is the first that is wrong" json '[r["line"] for r in d["lines"] if not r.get("holds", True)][:2] == ["m2 l^2 theta_ddot + m2 l x_ddot cos(theta) - m2 g l sin(theta) = 0", "l theta_ddot + x_ddot cos(theta) - g sin(theta) = 0"] and d["lines"][-1]["formula"] == "-(m1 + m2) g/(m1 l)"'
run derive double_pendulum --latex
check "derive --latex: environments close" eval '[ "$(grep -c "begin{align" "$work/out")" -eq "$(grep -c "end{align" "$work/out")" ] && grep -qF "\\ddot{\\theta}_{1}" "$work/out"'
check "docs/derive.md: commands print what it says" python3 -c 'import re, subprocess, sys
blocks = re.findall(r"```console\n(.*?)```", open("docs/derive.md").read(), re.S)
bad = len(blocks) != 6
for block in blocks:
    first, _, text = block.partition("\n")
    words = first.removeprefix("$ lagrangia ").split(" | ")
    got = subprocess.run([sys.argv[1]] + words[0].split(), text=True, stdout=subprocess.PIPE).stdout
    for tool in words[1:]:
        got = subprocess.run(tool.split(), input=got, text=True, stdout=subprocess.PIPE).stdout
    bad = bad or got != text
sys.exit(bad)' "$program"
run derive pendulum --set pendulum%b=0.1
check "derive: friction beside L" grep -q '^   m l^2 theta_ddot + b theta_dot + m g l sin(theta) = 0$' "$work/out"
refuses 2 "derive what?" derive
refuses 2 "slip 'E7' is no formula of a derivation; those are E1, E2, E3, E21, E25" derive cart_pendulum --slip E7
refuses 2 "slip 'E1' is one of the cart_pendulum" derive wedge --slip E1
refuses 2 "unknown slip 'E99'" derive wedge --slip E99
refuses 2 "do not go together" derive wedge --latex --json
refuses 2 "take fewer bodies" derive hanging_chain --set hanging_chain%n=6

# status 1: a tolerance that does not hold
run run pendulum --set scene%expect_error=1e-30 --output "$work/o"
check "status 1: a tolerance is missed" eval '[ $status -eq 1 ] && one_line && grep -q "1 of 1 scene did not hold" "$work/err" && grep -q "NOT as expected: error is 2.*, expect_error = 1e-30" "$work/out" && [ -s "$work/o/pendulum.dat" ]'

# status 2: usage, scenes, parameters; before any file is touched
refuses 2 "did you mean 'cart_pendulum'?" run cart_pendulm --output "$work/none"
refuses 2 "did you mean 'columns'?" run pendulum --set scene%colums=t --output "$work/none"
refuses 2 "unknown option '--quite'; did you mean '--quiet'?" --quite
refuses 2 "unknown command 'rnu'; did you mean 'run'?" rnu
refuses 2 "run what?" run
refuses 2 "describe what?" describe
refuses 2 "did you mean 'wedge'?" describe wegde
refuses 2 "unknown format 'txt'" run pendulum --format txt
refuses 2 "needs a value" run pendulum --set
refuses 2 "these methods work: rk4, stormer_verlet, midpoint, gauss16, and with a tolerance gauss16, dop853" run cart_pendulum --set scene%method=verlet --output "$work/none"
refuses 2 "these methods work: rk4, gauss16, and with a tolerance gauss16, dop853" run rolling_disk --set scene%method=midpoint --set scene%dt=1e-3 --output "$work/none"
printf "&scene system = 'pendulum' dt = 0.1 duration = 1 q = 1.0 /&lagrangian coordinates = 'x' L = 'x_dot^2/2' /" >"$work/taken.nml"
refuses 2 "system = 'pendulum': is a system that the program has; leave &lagrangian out" run "$work/taken.nml" --output "$work/none"
refuses 2 "alpha = 2: from 0.0 to pi/2 is needed" run wedge --set wedge%alpha=2 --output "$work/none"
refuses 2 " of pendulum are one file: one would be lost" run pendulum pendulum_rotation --set scene%output=a --output "$work/none"
refuses 2 "given twice, as 'a' and 'b'" run pendulum --output a --output=b
refuses 2 "given twice, as '' and 'svg'" run pendulum --plot --plot=svg
refuses 2 "&pendulum: l is given twice (first by another --set)" run pendulum --set pendulum%l=1 --set pendulum%l=2 --output "$work/none"
run run pendulum --set scene%dt=1e-2 --set scene%dt=1e-2 --output "$work/twice"
check "the same value twice is one change" eval '[ $status -eq 0 ] && grep -q "(dt=1e-2)$" "$work/out" && [ -s "$work/twice/pendulum_dt_1e-2.dat" ]'
refuses 2 "'manual' is a command; 'lagrangia help manual' tells of it" manual manual
check "a command's own name is told once" eval '! grep -q "shows what" "$work/err"'
refuses 2 "--systems: 'wedge' is given twice" bench steps --systems wedge,pendulum,wedge --quick
refuses 5 "$(printf "s%.0s" $(seq 40)).nml: no such file" bench precision steps --systems "$(printf "s%.0s" $(seq 40)).nml" --quick --output "$work/none"
odd="$work/it's a scene with a name of more than thirty-two letters.nml"
sed "s/'output.*//" data/scenes/pendulum.nml >"$odd"
for words in describe check derive modes "bench steps --quick --methods rk4 --systems"; do
    run $words "$odd"
    check "$words: writes no file that is called as the scene, and takes any name" [ "$status" -eq 0 ]
done
for words in run modes; do
    refuses 2 "give the scene an output, or its file another name" $words "$odd" --output "$work/none"
done
run bench steps --quick --methods rk4 --json --systems "$(ls data/scenes/*.nml | paste -sd,)"
check "bench steps: a column for each of many scenes" json 'len(d[0]) == 3 + '"$(ls data/scenes/*.nml | wc -l)"' and d[0]["data/scenes/rolling_disk_incline.nml"] > 0'
refuses 2 "lacks the letter of its exponent" bench --tolerances 1-3
refuses 2 "lacks the letter of its exponent" modes pendulum --at 1-3
refuses 2 "lacks the letter of its exponent" run pendulum --set scene%dt=1-3 --output "$work/none"
refuses 2 "behind '=' a number is needed, or a formula of numbers" run pendulum --set "scene%event='theta = abc'" --output "$work/none"
refuses 2 "begins or ends with a blank; write 'csv'" run pendulum --format 'csv ' --output "$work/none"
refuses 2 "begins or ends with a blank; write 'svg'" run pendulum --plot='svg ' --output "$work/none"
refuses 2 "begins or ends with a blank; write 'wedge'" describe 'wedge '
refuses 2 "unknown command 'run '; did you mean 'run'?" 'run ' pendulum
refuses 2 "unknown command ''" '' run pendulum
refuses 2 "unknown scene 'pendulum '; did you mean 'pendulum'?" run 'pendulum ' --output "$work/none"
refuses 2 "unknown system 'pendulum " check "pendulum                            x"
refuses 5 "pendulum.nml\\x20: no such file; there is one without that blank" run 'data/scenes/pendulum.nml '
refuses 5 "\\x20data/scenes/pendulum.nml: no such file; there is one without that blank" run ' data/scenes/pendulum.nml'
cp data/scenes/pendulum.nml "$work/blank.nml "
run run "$work/blank.nml " --quiet --set scene%output=blank --output "$work/b "
check "names that end with a blank are those files" eval '[ $status -eq 0 ] && [ -s "$work/b /blank.dat" ]'

# In any folder the program has its scenes, sheets and references with it
away() { # away WORDS...: as run, in a folder that has nothing but what was put there
    mkdir -p "$work/away"
    (cd "$work/away" && timeout 120 "$program" "$@") >"$work/out" 2>"$work/err" </dev/null
    status=$?
}
away run pendlum
check "elsewhere: a wrong word is named, with the nearest" eval '[ $status -eq 2 ] && one_line && grep -qF "unknown scene '"'pendlum'"'; did you mean '"'pendulum'"'?" "$work/err"'
away run data/scenes/pendulum.nml
check "elsewhere: a path is a path" eval '[ $status -eq 5 ] && one_line && grep -qF "data/scenes/pendulum.nml: no such file; did you mean '"'pendulum'"'?" "$work/err"'
away --json
check "elsewhere: lagrangia alone runs every scene" json 'len(d) == '"$scenes"' and all(row["verdict"] == "holds" for row in d)'
check "elsewhere: the same bytes" eval 'for f in data/scenes/*.nml; do f=$(basename "$f" .nml); cmp "$work/all/$f.dat" "$work/away/data/output/$f.dat" || exit 1; done'
for words in "list" "describe wedge" "describe spring_pendulum" "modes pendulum_slack --output o" "derive spring_pendulum" "check spring_pendulum" "principle action --output o" \
    "bench steps --systems pendulum --quick --output o" "bench precision --problems P4 --methods dop853 --tolerances 1e-9 --quick --output o" "errata E1" "grade right" "grade data/homework/right.txt"; do
    away $words
    check "elsewhere: $words" [ $status -eq 0 ]
done
away grade atwood
check "elsewhere: a sheet by name" eval '[ $status -eq 1 ] && grep -q "2 right, 2 wrong" "$work/out"'
away grade atwod
check "elsewhere: a wrong sheet is named" eval '[ $status -eq 5 ] && one_line && grep -qF "atwod: no such file; did you mean the sheet '"'atwood'"'?" "$work/err"'
away show pendulum
check "show: a scene, byte for byte" cmp "$work/out" data/scenes/pendulum.nml
away show atwood atwood.txt homework/right.txt
check "show: scenes and sheets, as they are" eval 'cat data/scenes/atwood.nml data/homework/atwood.txt data/homework/right.txt | cmp - "$work/out"'
refuses 2 "no file 'pendlum' comes with the program; did you mean 'pendulum'?" show pendulum pendlum
mkdir -p "$work/away/data/scenes" && sed "s/title = .*/title = 'Mine'/" data/scenes/pendulum.nml >"$work/away/data/scenes/pendulum.nml"
away list scenes
check "a folder's own scenes come first" eval '[ "$(head -n 1 "$work/out")" = "pendulum                    Mine" ] && [ "$(wc -l <"$work/out")" -eq "$scenes" ]'
away --json
check "a folder's own scenes are those that run" json 'len(d) == 1'
long=$(printf '%03000d' 0)
for words in "$long" "run $long" "run pendulum --$long" "run pendulum --format $long" "run pendulum --plot=$long" "run pendulum --set scene%dt=$long.x" \
    "run pendulum --set $long" "run pendulum $long" "modes $long" "modes pendulum --at $long,x" "describe $long" "describe wedge $long" "list $long" \
    "errata $long" "principle $long" "stress $long" "check $long" "bench $long" "bench --tolerances $long" "bench --methods $long"; do
    refuses 2 "" $words
done
check "status 2 leaves no folder" [ ! -e "$work/none" ]

# status 3: the numbers fail; the good rows stay
run run oscillator_verlet --set scene%dt=1.5 --set scene%duration=15000 --set scene%every=1 --output "$work/blown"
check "status 3: the state overflows" eval '[ $status -eq 3 ] && grep -q "not finite at t = " "$work/err" && grep -q " failed$" "$work/out" && [ "$(grep -vc "^#" "$work/blown/oscillator_verlet_dt_1.5_duration_15000.dat.partial")" -eq 185 ]'
check "status 3: no number in the file is odd" eval '! grep -v "^#" "$work/blown/oscillator_verlet_dt_1.5_duration_15000.dat.partial" | grep -qi "nan\|inf\|\*"'
run run oscillator_verlet --json --set scene%dt=1.5 --set scene%duration=15000 --set scene%every=1 --output "$work/blown"
check "status 3: --json is still JSON" json 'd[0]["verdict"] == "failed" and all(abs(x) < 1e308 for x in d[0]["q"])'

# status 5: files
refuses 5 "no such file" run "$work/none.nml"
refuses 5 "no such file; did you mean 'pendulum'?" run data/scene/pendulum.nml
refuses 5 "/a.nml: File name too long" run "$long/a.nml"
run run pendulum --quiet --output "$work/$long"
check "a folder's name that is too long" eval '[ $status -eq 5 ] && one_line && grep -q "/pendulum.dat.: .*: File name too long$" "$work/err"'
echo data >"$work/file"
run run pendulum --output "$work/file"
check "status 5: the output folder is a file" eval '[ $status -eq 5 ] && one_line && [ "$(cat "$work/file")" = data ]'
run run pendulum --json --output "$work/file"
check "status 5: --json says that it failed, and names no file" json 'd[0]["verdict"] == "failed" and d[0]["file"] is None'
if [ -e /dev/full ]; then
    "$program" list systems >/dev/full 2>"$work/err"
    status=$?
    check "status 5: stdout is full" eval '[ $status -eq 5 ] && one_line'
    "$program" grade data/homework/atwood.txt >/dev/full 2>"$work/err"
    status=$?
    check "status 5: stdout is full, and a statement is wrong" eval '[ $status -eq 5 ] && one_line &&
        grep -q "^lagrangia: wrong: 2 statements; cannot write standard output: No space left on device$" "$work/err"'
fi
"$program" list systems >&- 2>"$work/err"
status=$?
check "status 5: stdout is closed" eval '[ $status -eq 5 ] && one_line'
for closed in '<&-' '>&-' '2>&-' '<&- >&-' '<&- >&- 2>&-'; do # no file or pipe may then take the place of one of them
    expected=0
    [[ $closed == *' >&-'* || $closed == '>&-'* ]] && expected=5
    eval "timeout 60 \"\$program\" sweep pendulum --over q=0.1:3.1:50 --keep period --threads 2 --output \"\$work/closed\" >\"\$work/out\" 2>\"\$work/err\" $closed"
    check "sweep $closed: comes to its end" [ $? -eq $expected ]
done
mkdir "$work/kept"
echo old >"$work/kept/pendulum.dat"
(ulimit -f 8; "$program" run pendulum --output "$work/kept" >"$work/out" 2>"$work/err")
status=$?
check "status 5: the disk is full, and the old file unharmed" eval '[ $status -eq 5 ] && one_line && [ "$(cat "$work/kept/pendulum.dat")" = old ] && leftovers'

# little stack, little memory; names that other programs would run; pages without empty ends
for limit in "-s 64" "-v 100000"; do
    (ulimit $limit; exec timeout 120 "$program" list >"$work/out" 2>"$work/err" </dev/null)
    status=$?
    check "ulimit $limit: status 4, and what it lacks" eval '[ $status -eq 4 ] && one_line && grep -q "ulimit -s 8192\|not enough memory: lagrangia needs 150 MB more" "$work/err"'
done
if command -v gnuplot >/dev/null; then
    cp data/scenes/pendulum.nml "$work/swing.nml"
    (cd "$work" && timeout 120 "$program" run swing.nml --plot=svg --quiet "--output=<touch owned;true " >out 2>err </dev/null)
    status=$?
    check "a folder called <touch: drawn, nothing is run" eval '[ $status -eq 0 ] && [ -n "$(find "$work/<touch owned;true " -name "*.svg" -size +0)" ] && [ ! -e "$work/owned" ]'
fi
printf "&scene system = 'own' dt = 0.1 duration = 1 q = 1.0 /&lagrangian coordinates = 'x' L = 'x_dot^2/2 - x^2/2' /" >"$work/untitled.nml"
for words in list "describe pendulum" "describe $work/untitled.nml" "derive $work/untitled.nml" "derive $work/untitled.nml --fortran" "modes $work/untitled.nml" "check $work/untitled.nml" errata "errata E1" principle "principle gauge" "check pendulum" "modes pendulum" "run pendulum --output $work/o" --help; do
    run $words
    check "$words: no line ends with a blank" eval '! grep -q " $" "$work/out"'
    check "$words: no empty line first, last, or beside another" eval '[ $status -eq 0 ] && [ -n "$(head -n 1 "$work/out")" ] && [ -n "$(tail -n 1 "$work/out")" ] && [ "$(cat -s "$work/out")" = "$(cat "$work/out")" ]'
done

# signals: in the middle of a long run
interrupt() { # interrupt SIGNAL STATUS
    env -u OPENBLAS_NUM_THREADS "$program" run pendulum --set scene%output=pendulum --set scene%duration=1e6 --set scene%every=1000 --output "$work/kept" >"$work/out" 2>"$work/err" &
    local child=$! i threads
    for i in $(seq 100); do # until its temporary file is there
        [ -n "$(find "$work/kept" -name '.lagrangia-*')" ] && break
        sleep 0.02
    done
    threads=$(sed -n 's/^Threads:[^0-9]*//p' "/proc/$child/status" 2>/dev/null)
    kill -"$1" "$child"
    wait "$child"
    status=$?
    check "SIG$1: it was one thread" eval '[ "${threads:-1}" -eq 1 ]'
    check "SIG$1: status $2, no file left, the old one unharmed" eval '[ $status -eq '"$2"' ] && one_line && leftovers && [ "$(cat "$work/kept/pendulum.dat")" = old ]'
}
set -m # else a shell lets its background jobs ignore SIGINT
interrupt INT 130
interrupt TERM 143
# a system in formulas, from a scene
spring=data/scenes/spring_pendulum.nml
run run "$spring" --output "$work/o"
check "formulas: a run, and its file" eval '[ $status -eq 0 ] && grep -q " holds$" "$work/out" && [ -s "$work/o/spring_pendulum.dat" ]'
sed -n "/^# &scene/,/^# build/{/^# build/d;s/^# //p}" "$work/o/spring_pendulum.dat" >"$work/spring_pendulum.nml"
run run "$work/spring_pendulum.nml" --output "$work/again"
check "formulas: the echo in the data file runs again, with the same rows" eval '[ $status -eq 0 ] && cmp <(grep -v "^#" "$work/o/spring_pendulum.dat") <(grep -v "^#" "$work/again/spring_pendulum.dat")'
run run "$spring" --format csv --output "$work/o" --set spring_pendulum%g=0 --set "scene%columns='t','p_theta','p_theta_drift'" --set scene%plot=p_theta
check "formulas: without gravity the angle's momentum is conserved" eval '[ $status -eq 0 ] && tail -n 1 "$work/o/spring_pendulum.csv" | awk -F, "{ exit !(\$3 < 1e-10 && \$3 > -1e-10) }"'
run modes "$spring" --json
check "formulas: modes k/m and g/(l0 + m g/k)" json 'd["system"] == "spring_pendulum" and abs(d["omega2"][1]/40 - 1) < 1e-14 and abs(d["omega2"][0]/(9.81/1.24525) - 1) < 1e-13'
run check "$spring"
check "formulas: the audit holds" eval '[ $status -eq 0 ] && grep -q " 0 do not hold" "$work/out"'
run describe "$spring"
check "formulas: the equations are written" grep -qF "m r^2 theta_ddot + 2 m r r_dot theta_dot + m g r sin(theta) = 0" "$work/out"
run run "$spring" --set "lagrangian%parameters='m','k','l0','g','b'" --set spring_pendulum%b=1 --output "$work/o"
check "formulas: a parameter for nothing is said" eval '[ $status -eq 0 ] && grep -qF "no formula contains b" "$work/err"'
refuses 2 "&lagrangian: V: column 9: 'cos' needs brackets; write 'cos(theta)'" run "$spring" --set "lagrangian%V=m g cos theta r" --output "$work/none"
refuses 2 "the mass matrix d2L/dv dv is singular" run "$spring" --set "scene%q=0,1" --output "$work/none"
refuses 2 "L has no theta_dot in it" modes "$spring" --set "lagrangian%T=m/2 r_dot^2"
refuses 2 "give either L, or T and V" check "$spring" --set "lagrangian%L=r_dot^2"
refuses 2 "unknown name 'thetadot'; did you mean 'theta_dot'?" describe "$spring" --set "lagrangian%T=m thetadot^2"
refuses 2 "--set goes with one scene" check "$spring" pendulum --set spring_pendulum%k=2
refuses 2 "--set goes with one scene" check methods --set pendulum%l=2
refuses 2 "--set pendulum%l=-1: &pendulum: l = -1: greater than 0.0 is needed" check pendulum --set pendulum%l=-1
refuses 2 "pendulum: m = 1e80: 'check' takes 0 and sizes from 1e-75 to 1e75, of which fourth powers" check pendulum --set pendulum%m=1e80
refuses 2 "event_columns, ...; 'lagrangia describe scene' has all" run pendulum --set scene%foo=1
chain="lagrangia describe hanging_chain --set hanging_chain%n=10"
refuses 2 "theta4_dot, ...; '$chain' has all" run hanging_chain --set scene%columns=foo
refuses 2 "energy_drift; 'columns' adds others, '$chain' has all" run hanging_chain --set scene%plot=foo
refuses 2 "did you mean 'theta3', which 'columns' adds?" run hanging_chain --set scene%plot=thta3
refuses 2 "'theta3' is none of this scene's columns; 'columns' adds it" run hanging_chain --set scene%plot=theta3
run ${chain#lagrangia }
check "the command that is named shows the columns of ten bobs" grep -q "theta10_ddot" "$work/out"
refuses 2 "a sweep cannot change 'hanging_chain%l'; did you mean 'l'?" sweep hanging_chain --over hanging_chain%l=1:2:3 --keep period
run run hanging_chain --set scene%duration=0.1 --animate --quiet --output "$work/whole"
printf '%s\n' "&scene system = 'pendulum', dt = 0.1, duration = 1, q = 1 /" >"$work/no_title.nml"
run report "$work/no_title.nml" --output "$work/whole"
check "a report names a scene that has no title" eval 'grep -q "<h2>no title</h2>" "$work/whole/report.html" && grep -q "no title</a></li>" "$work/whole/report.html"'
check "a film says how many bobs there are, by a whole number" grep -q '"n = 10"' "$work/whole/"hanging_chain*.html
run run duffing --set scene%duration=30 --set scene%samples=30 --quiet --output "$work/whole"
check "a picture of events says what vanishes" grep -q "where strobe = 0; strobe: zero once in each period of the drive" "$work/whole/"duffing*events.gp
run sweep basins --over theta=-3:3:5 --over theta_dot=-4:4:5 --output "$work/whole"
check "attractors are counted" grep -qE "^  attractor  [01] to [12]$" "$work/out"
check "and it says where each is, and how many come to it" eval 'grep -qE "^    [12] at theta = 3.142, theta_dot = 0.0: [0-9]+ trajectories$" "$work/out" &&
    awk "/ trajectories$/ { n += \$(NF - 1) } END { exit n != 25 }" "$work/out" &&
    grep -q "^# trajectories: 25, failed: 0; attractor 1 at theta = " "$work/whole/basins_theta_-3_3_5_theta_dot_-4_4_5_sweep.dat"'
check "a changed sweep leaves the file of the sweep alone" [ ! -e "$work/whole/basins_sweep.dat" ]
check "a sweep says its time in plain digits" grep -qE "^basins: 25 trajectories by rk4 in [0-9.]+(e-[45])? s by" "$work/out"
run sweep basins --over theta=-3:3:5 --set scene%output=mine/basins --set driven_pendulum%b=2 --output "$work/whole"
check "an output that is set is the file" [ -s "$work/whole/mine/basins_sweep.dat" ]
run sweep pendulum --over theta=0.5:2:3 --keep lyapunov --set scene%duration=5 --set scene%method=rk4 --output "$work/whole"
check "a sweep names the method of its exponents" grep -q "^pendulum: 3 trajectories by gauss16 in " "$work/out"
run sweep pendulum --over theta=0.5:2:3 --keep lyapunov,theta --set scene%duration=5 --set scene%method=rk4 --output "$work/whole"
check "and beside it the one of the motion" grep -q "^pendulum: 3 trajectories by rk4, exponents by gauss16 in " "$work/out"
printf '%s\n' "&scene system = 'own', dt = 0.1, duration = 1, q = 20*0 /" "&lagrangian coordinates = 'x_1 .. x_20', parameters = 'k_1 .. k_40'," \
    "  T = 'sum(i, 1, 20, x_i_dot^2)', V = 'sum(i, 1, 40, k_i x_1^2)' /" "&own $(printf 'k_%s = 1, ' $(seq 40)) /" >"$work/own.nml"
refuses 2 "...; 'lagrangia describe SCENE' has all; parameters are named in &lagrangian: parameters" run "$work/own.nml" --set own%foo=1
refuses 2 "own has t, x_1, x_1_dot, " run "$work/own.nml" --set scene%columns=foo
check "a column of a system in formulas: describe with its scene has all" grep -q "x_6, ...; 'lagrangia describe SCENE' has all$" "$work/err"
refuses 2 "there are x_1, x_1_dot, x_2, " sweep "$work/own.nml" --over foo=1:2:3 --keep x_1
check "what a sweep can change: describe with its scene has all" grep -q "...; 'lagrangia describe SCENE' has all$" "$work/err"
run describe "$work/own.nml"
check "and that is so" eval 'grep -q "^  k_40 " "$work/out" && sed -n "/^all columns of a scene/,/^column error/p" "$work/out" | tr -d "\n" | grep -q " x_20_ddot, .* energy_drift, .*p_x_20"'
missing=
for name in $(ls data/scenes); do # each column that a scene writes is among those of describe
    run describe "data/scenes/$name"
    python3 -c 'import re, sys
listed = re.search(r"^all columns of a scene\n(.*?)^column error", open(sys.argv[1]).read(), re.S | re.M).group(1)
listed = re.split(r",?\s+", listed.strip())
header = [line for line in open(sys.argv[2]) if line.startswith("#")][-1]
written = [word.split("[")[0] for word in header[1:].split()]
sys.exit(not (written and set(written) <= set(listed)))' "$work/out" "$work/all/${name%.nml}.dat" || missing+=" $name"
done
check "describe: all columns that a shipped scene writes, not$missing" [ -z "$missing" ]
refuses 2 "&pendulum: unknown key 'zz'; allowed: m, l, g, b" check pendulum --set pendulum%zz=1
refuses 2 "unknown group 'pendulum'; allowed: wedge" check wedge --set pendulum%l=1
refuses 2 "unknown system 'pendlum'; did you mean 'pendulum'?" check pendlum
refuses 5 "no such file" modes "$work/nothing.nml"
check "formulas: nothing refused left a file" [ ! -e "$work/none" ]

# quantities of a scene's own
run run kepler --json --output "$work/o"
check "quantities: the Laplace vector is kept" json 'd[0]["drifts"]["A_x_drift"] < 1e-10 and d[0]["drifts"]["A_y_drift"] < 1e-10'
run describe kepler
check "quantities: conserved ones are found" eval '[ $status -eq 0 ] && sed -n "/^conserved besides/,/^other/p" "$work/out" | grep -q "A_y .*-p_x L_z - m k sin(phi): Laplace"'
run describe kepler_precession
check "quantities: others are not conserved" eval '[ $status -eq 0 ] && sed -n "/^other columns/,/^column error/p" "$work/out" | grep -q "A_y .*-p_x L_z - m k sin(phi): Laplace"'
run check two_bodies
check "quantities: the audit knows them" eval '[ $status -eq 0 ] && grep -q "X_0 is conserved .* holds" "$work/out" && grep -q "X_0 as printed .* holds" "$work/out"'
refuses 2 "column 'A_x_drift': A_x of this kepler is not conserved; there is 'A_x'" run kepler_precession --set "scene%columns='t','A_x_drift'" --output "$work/none"
refuses 2 "two columns would be called 'energy'" run kepler --set "lagrangian%quantities='energy=r'" --output "$work/none"
# what a student types first
refuses 2 "unknown command 'plot'; '--plot' is an option, as in 'lagrangia run SCENE... --plot'" plot pendulum
refuses 2 "unknown command 'keep'; did you mean 'sweep'?" keep
refuses 2 "theta = 1: is a coordinate; its start is q(1) of &scene, as in --set 'scene%q(1)=0.5'" run pendulum --set pendulum%theta=1 --output "$work/none"
refuses 2 "theta2_dot = 1: is a velocity; its start is v(2) of &scene, as in --set 'scene%v(2)=0.5'" run double_pendulum --set double_pendulum%theta2_dot=1 --output "$work/none"
refuses 2 "phi = 1: is a coordinate; its start is q(2) of &scene" run kepler --set kepler%phi=1 --output "$work/none"
check "a coordinate is no parameter: nothing is said of parameters" eval '! grep -q "parameters are" "$work/err"'
run run double_pendulum --set 'scene%q(2)=0.5' --json --output "$work/first"
check "a coordinate is no parameter: the remedy works" eval '[ $status -eq 0 ] && [ "$(sed -n "/^[^#]/{p;q}" "$work/first/double_pendulum_q_2_0.5.dat" | awk "{ print \$2*1, \$3*1 }")" = "0.3 0.5" ]'
refuses 2 "alpha = 45: from 0.0 to pi/2 is needed; angles are in radians: 45.0 degrees are 0.7853981633974483" run wedge --set wedge%alpha=45 --output "$work/none"
run run pendulum --set scene%q=90 --quiet --output "$work/first"
check "90 rad, --quiet: nothing is said" eval '[ $status -eq 0 ] && [ ! -s "$work/err" ]'
run run pendulum --set scene%q=90 --output "$work/first"
check "90 rad may be meant as degrees" eval '[ $status -eq 0 ] && one_line && grep -qF "theta starts at 90.0 rad; angles are in radians: 90.0 degrees are 1.5707963267948966" "$work/err"'
run sweep pendulum --over theta=0:180:3 --keep "max theta" --output "$work/sweep"
check "an axis to 180 rad may be meant as degrees" eval '[ $status -eq 0 ] && one_line && grep -qF "the axis theta is in rad; angles are in radians: 180.0 degrees are 3.141592653589793" "$work/err"'
run sweep pendulum --over theta=0:3:3 --keep "max theta" --output "$work/sweep"
check "an axis to 3 rad is not" eval '[ $status -eq 0 ] && [ ! -s "$work/err" ]'
refuses 2 "; angles are in radians: 180.0 degrees are 3.141592653589793" modes pendulum --at 180
refuses 2 "an equilibrium of pendulum has 1 value, not 2; a decimal point, no comma, is needed in a number" modes pendulum --at 3,14
refuses 2 "the axis theta: '180deg': no degrees are read; an angle is in radians, 3.141592653589793" sweep pendulum --over theta=0:180deg:5 --keep period
refuses 2 "a sweep cannot change 'length'; did you mean 'l'?" sweep pendulum --over length=0.5:2:5 --keep period
refuses 2 "not 'Period'; did you mean 'period'?" sweep pendulum --over theta=0.1:3:5 --keep Period
refuses 2 "not 'max(theta_dot)'; did you mean 'max theta_dot'?" sweep pendulum --over theta=0.1:3:5 --keep "max(theta_dot)"
refuses 2 "not 'amplitude'; did you mean 'max theta'?" sweep pendulum --over theta=0.1:3:5 --keep amplitude
refuses 2 "this is a setting; write '--set pendulum%l=2'" modes pendulum --set l=2
refuses 2 "not 'T'; did you mean 'period'?" sweep pendulum --over theta=0.1:3:5 --keep T
refuses 2 "--set l=2: this is a setting; write '--set pendulum%l=2'" run pendulum --set l=2
refuses 2 "--set theta=1: this is a start; write '--set scene%q=1'" run pendulum --set theta=1
refuses 2 "--set theta=0:1:5: this is an axis; write '--over theta=0:1:5'" sweep pendulum --set theta=0:1:5
refuses 2 "method = verlet: verlet is for forces that depend on positions only" run skate --set scene%method=verlet
refuses 2 "write --set 'scene%title=hello world'" run pendulum "title=hello world"
refuses 2 "write '--set scene%q=0.7853981633974483'" run pendulum "theta=45 deg"
refuses 5 "nosuch.nml: no such file" run nosuch.nml r=1
refuses 2 "'y=1' is a start; write '--set scene%q=1'" run bouncing_ball y=1
refuses 2 "l: '5x' is not a number; write it like 0.01" run pendulum --set pendulum%l=5x
refuses 2 "sweep over what? '--over y=0.1:3:50', or over = 'y = 0.1:3:50'" sweep bouncing_ball --output "$work/none"
refuses 2 "sweep over what? '--over m=0.1:3:50', or over = 'm = 0.1:3:50'" sweep pendulum_in_x_and_y --output "$work/none"
run sweep pendulum_in_x_and_y --over m=0.1:3:50 --keep period --set scene%duration=3 --output "$work/o"
check "sweep: the axis that is advised where constraints hold the coordinates can be swept" [ "$status" -eq 0 ]
mkdir -p "$work/another"
echo another >"$work/another/pendulum_sweep.dat.part"
refuses 5 "is of another sweep" sweep pendulum --over theta=0:1:5 --keep period --output "$work/another"
check "sweep: what another sweep has computed stays" grep -qx another "$work/another/pendulum_sweep.dat.part"
cp data/scenes/pendulum.nml "$work/pendulum_with_a_long_name.nml"
run run "$work/pendulum_with_a_long_name.nml" kepler --output "$work/o"
check "run: a long name has a line of its own, and the columns stand" eval 'grep -qx "pendulum_with_a_long_name" "$work/out" && [ "$(grep -c " holds$" "$work/out")" = 2 ] && [ "$(grep "holds$" "$work/out" | awk "{ print length }" | sort -u | wc -l)" = 1 ]'
refuses 2 "an axis of a sweep looks like 'y = 0.1:3:50'" sweep bouncing_ball --over y --keep y --output "$work/none"
refuses 2 "the axis v needs FROM:TO:COUNT, as in 'v = 0.1:3:50'" sweep bouncing_ball --over v=1:2 --keep y --output "$work/none"
refuses 2 "the axis y: an end is missing; write 'y = 0.1:3:50'" sweep bouncing_ball --over y=:2:3 --keep y --output "$work/none"
refuses 2 "as in event = 'y = 0.5 rising' or event = 'y_dot falling stop'" run bouncing_ball --set "scene%event='y ='" --output "$work/none"
refuses 2 "'first y = 0.5 rising', 'max COLUMN'" sweep bouncing_ball --over y=1:2:3 --keep first --output "$work/none"
refuses 2 "only columns are kept, 'x' or 'wrapped x'" sweep ueda --set "sweep%strobe=2 pi" --keep period --output "$work/none"
refuses 2 "; write pendulum%l=2" run pendulum --set pendulum.l=2
refuses 2 "this is a setting; write '--set pendulum%b=0.1'" run pendulum --set b=0.1
refuses 2 "; the groups are scene, atwood" --set b=0.1
refuses 2 "it is a key of the scene: --set scene%dt=..." run pendulum --dt 0.01
refuses 2 "period_of = θ: a coordinate is needed: theta" run pendulum --set scene%period_of=θ
refuses 2 "'0;0': a number is needed; several have commas between them" modes double_pendulum --at '0;0'
run compare pendulum --starts "45 90" --output "$work/o"
check "starts of 45 and 90 rad may be meant as degrees" eval '[ $status -eq 0 ] && one_line && grep -qF "theta starts at 45.0 rad; angles are in radians: 45.0 degrees are 0.7853981633974483" "$work/err"'
run run rotating_wire --set rotating_wire%omega=100 --output "$work/o"
check "an energy that rounding has swallowed is said to be that" eval '[ $status -eq 0 ] && tr -s " \n" " " <"$work/out" | grep -q "the terms of the energy have grown to [0-9.]*E+259 times .* that drift is their rounding"'
run run symmetric_top --set symmetric_top%i1=1.5 --output "$work/o"
check "a changed parameter keeps its letters" grep -q "(I1=1.5)" "$work/out"
refuses 2 "latitude = 48: from -pi/2 to pi/2 is needed; angles are in radians: 48.0 degrees are 0.837" run foucault --set foucault%latitude=48 --output "$work/none"
run run duffing --set duffing%f=0 --output "$work/first"
check "one step is no steps" eval '[ $status -eq 0 ] && grep -q "^    1 step, [0-9]* evaluations of the accelerations" "$work/out"'
run run pendulum --set scene%expect_error=1e-20 --output "$work/first"
check "one scene does not hold its tolerances" eval '[ $status -eq 1 ] && [ "$(cat "$work/err")" = "lagrangia: 1 of 1 scene did not hold its tolerances" ]'
run run pendulum --set scene%q=91 --output "$work/first"
check "91 rad are no degrees" eval '[ $status -eq 0 ] && [ ! -s "$work/err" ]'
run run oscillator --set scene%q=90 --output "$work/first"
check "90 m are no degrees" eval '[ $status -eq 0 ] && [ ! -s "$work/err" ]'
run run pendulum --set pendulum%b=5 --output "$work/first"
check "omega of a pendulum with drag is that without" eval '[ $status -eq 0 ] && grep -q "^    omega .* the slowest small oscillation without forces beside L" "$work/out"'
run run pendulum --output "$work/first"
check "omega of a pendulum without" eval '[ $status -eq 0 ] && grep -q "^    omega .* the slowest small oscillation, by LAPACK" "$work/out"'
run modes rotating_frame
check "modes of a free particle in a rotating frame: it does not stay near" eval '[ $status -eq 0 ] && grep -q "^modes 1 and 2 have one omega and one shape; the other motion grows as t$" "$work/out"'
run modes foucault
check "modes of a Foucault pendulum: two" eval '[ $status -eq 0 ] && ! grep -q "grows as t" "$work/out"'
run modes cart_pendulum --animate --output "$work/first"
check "the film of a zero mode says what it is" eval 'grep -qF "\"name\": \"mode 1: uniform motion\"" "$work/first/cart_pendulum_modes.html" && grep -qF "<title>Cart pendulum: small oscillations</title>" "$work/first/cart_pendulum_modes.html"'
run modes charged_particle --set charged_particle%electric=0,0,0 --animate --output "$work/first"
check "a charge in a magnetic field is at rest in a zero mode across it, and moves along it" eval '[ $status -eq 0 ] && grep -qF "mode 1: at rest beside the equilibrium" "$work/first/charged_particle_electric_0_0_0_modes.html" && grep -qF "mode 2: uniform motion" "$work/first/charged_particle_electric_0_0_0_modes.html" && grep -v "^#" "$work/first/charged_particle_electric_0_0_0_mode_1.dat" | awk "{ if (NR == 1) x = \$2; if (\$2 != x || x*1 == 0) bad = 1 } END { exit bad }" && grep -v "^#" "$work/first/charged_particle_electric_0_0_0_mode_2.dat" | awk "{ if (\$4 < z) bad = 1; z = \$4 } END { exit bad || z < 0.099 }"'
run modes pendulum --set pendulum%l=2 --at 3.141592653589793 --output "$work/first" --animate
check "modes --set and --at: files and titles of its own, the unchanged system keeps its" eval '[ $status -eq 0 ] && head -n 1 "$work/first/pendulum_l_2_at_3.141592653589793_mode_1.dat" | grep -qF "# pendulum (l=2, at=3.141592653589793), mode 1: omega^2 = -4.905" && grep -qF "Pendulum (l=2, at=3.141592653589793): small oscillations" "$work/first/pendulum_l_2_at_3.141592653589793_modes.html" && grep -qF "pendulum (l=2, at=3.141592653589793): small oscillations" "$work/first/pendulum_l_2_at_3.141592653589793_modes.gp" && [ ! -e "$work/first/pendulum_modes.dat" ]'
run modes rotating_hoop_rest --output "$work/named" --animate
check "modes of a scene: files and titles by the scene's name" eval '[ $status -eq 0 ] && head -n 1 "$work/named/rotating_hoop_rest_mode_1.dat" | grep -qF "# rotating hoop rest, mode 1" && grep -qF "\"rotating hoop rest: small oscillations\"" "$work/named/rotating_hoop_rest_modes.gp" && grep -qF "<title>Rotating hoop rest: small oscillations</title>" "$work/named/rotating_hoop_rest_modes.html" && [ ! -e "$work/named/rotating_hoop_modes.html" ]'
run compare pendulum --starts "1 2" --output "$work/first"
check "compare --starts: its title, and no columns without numbers" eval '[ $status -eq 0 ] && [ "$(sed -n "1p;2p" "$work/out" | tr -s " " | tr "\n" ";")" = "pendulum from 2 starts; start steps evaluations seconds;" ]'
refuses 2 "--starts: '1' is given twice; Q1,Q2,... each, perhaps with :V1,V2,..., and blanks between them" compare double_pendulum --starts "1 1, 1 1.001"
refuses 2 "--methods: two at least are needed, to be compared; names with commas between them: rk4,verlet" compare pendulum --methods all
mkdir "$work/mine"
sed 's/^  title.*//' data/scenes/pendulum.nml >"$work/mine/min.nml"
refuses 5 "$work/mine/min: no such file; did you mean '$work/mine/min.nml'?" report "$work/mine/min"
(cd "$work/mine" && for words in "run min" "sweep min" "modes min" "describe min" "derive min"; do "$program" $words; done >/dev/null 2>"$work/err")
check "a file's name without its ending" [ "$(grep -c "; did you mean 'min.nml'?$" "$work/err")" -eq 5 ]
run compare "$work/mine/min.nml" --methods rk4,verlet --output "$work/first"
check "compare: the name of a scene without a title" [ "$(head -n 1 "$work/out")" = min ]
run run pendulum --output data/scenes/pendulum.nml
check "where no file is written, none is promised" eval '[ $status -eq 5 ] && grep -q failed "$work/out" && ! grep -q "data files" "$work/out"'

refuses 2 "quantities: column 5: unknown name 'rr'; did you mean 'r'" run kepler --set "lagrangian%quantities='d = rr'" --output "$work/none"
refuses 2 "a quantity is written 'L_z [kg m^2/s] angular momentum = m r^2 phi_dot'" run kepler --set "lagrangian%quantities='r^2'" --output "$work/none"
check "quantities: nothing refused left a file" [ ! -e "$work/none" ]

run --help
check "--help: a signal's status is what those were" eval 'formula=$(tr "\n" " " <"$work/out" | grep -o "128 . n signal n") && n=2 && [ $((${formula% signal n})) -eq 130 ]'

# a gnuplot that does not do what it should: it gets -d -c SCRIPT KIND PICTURE
mkdir "$work/bin" "$work/drawn"
fake() { # fake LINE KIND: gnuplot is a shell script of this line; draw a picture of that kind
    printf '#!/bin/sh\n%s\n' "$1" >"$work/bin/gnuplot"
    chmod +x "$work/bin/gnuplot"
    rm -f "$work"/drawn/*
    PATH=$work/bin:$PATH run run pendulum "--plot=$2" --quiet --output "$work/drawn"
}
fake 'printf "a picture IEND....." >"$5"' png
check "gnuplot: a whole picture gets its name" eval '[ $status -eq 0 ] && grep -q IEND "$work/drawn/pendulum.png"'
fake 'printf "<svg></svg>" >"$5"' svg
check "gnuplot: another whole picture" eval '[ $status -eq 0 ] && grep -q svg "$work/drawn/pendulum.svg"'
for line in 'printf "half of it" >"$5"' 'exit 0' 'printf "<svg></svg>" >"$5"'; do
    fake "$line" png
    check "gnuplot: no picture from $line" eval '[ $status -eq 5 ] && one_line && grep -q "gnuplot did not finish .*pendulum.png.: no space left" "$work/err" && [ ! -e "$work/drawn/pendulum.png" ] && leftovers'
done
fake 'exit 3' png
check "gnuplot: its status is told" eval '[ $status -eq 5 ] && one_line && grep -q "gnuplot ended with status 3 on " "$work/err" && [ ! -e "$work/drawn/pendulum.png" ] && leftovers'

run stress slow_rotation
check "stress: what holds stands under each other" awk '/ holds/ { at = index($0, " holds"); if (first && at != first) exit 1; first = at } END { exit !first }' "$work/out"

# what is said of a motion is true of it, however its formulas are written
mkdir "$work/said"
said() { # said FORMULAS: a mass in a plane, with V = k/2 x^2, and what is typed besides
    printf "%s\n" "&scene system='plane', method='gauss16', tolerance=1e-10, duration=1, q=1,1, v=0, 0 /" \
        "&lagrangian coordinates='x [m]','y [m]', parameters='m','k', T='m/2 (x_dot^2+y_dot^2)', V='k/2 (x^2 + y^2)', $1 /" "&plane m=1, k=2 /" >"$work/said/plane.nml"
}
for line in "x x_dot + y y_dot = 0|holonomic, scleronomic" "x_dot = y_dot|holonomic, scleronomic" "y x_dot = x y_dot|holonomic, scleronomic" "x_dot = k|holonomic, rheonomic" \
    "x = y|holonomic, scleronomic" "x = k t|holonomic, rheonomic" "x_dot = t y_dot|nonholonomic, rheonomic" "x_dot = x y|nonholonomic, scleronomic"; do
    IFS='|' read -r bond class <<<"$line"
    said "constraint='$bond'"
    sed -i "s/, v=0, 0//" "$work/said/plane.nml"
    [ "$bond" = "x = k t" ] && sed -i "s/q=1,1/q=0,1/" "$work/said/plane.nml"
    run describe "$work/said/plane.nml"
    check "a constraint, $bond, is $class" grep -q "^  $class: " "$work/out"
done
check "the unit of a multiplier is not known" grep -q '^  lambda1  *\[?\] ' "$work/out"
said "Q_x='k y_dot', Q_y='-k x_dot'"
run describe "$work/said/plane.nml"
check "forces that do no work leave the energy conserved" grep -qx 'energy (v dL/dv - L)' "$work/out"
run run "$work/said/plane.nml" --set "scene%columns='t','energy_drift'" --output "$work/said"
check "and it has a drift" [ $status -eq 0 ]
said "Q_x='k y_dot - m x_dot/1e30', Q_y='-k x_dot'"
run describe "$work/said/plane.nml"
check "a friction beside them does work, however small it is" grep -qx 'energy (v dL/dv - L), not conserved' "$work/out"
said "Q_x='-x_dot'"
sed -i "s/V='k/V='sin(t) + k/" "$work/said/plane.nml"
run describe "$work/said/plane.nml"
check "the time in L that drops out of the equations of motion" grep -q '^  2 degrees of freedom; accelerations depend on positions and velocities, though the time is in L$' "$work/out"
run modes "$work/said/plane.nml"
check "and has no part in the modes" eval '[ $status -eq 0 ] && [ "$(grep -c "^2.0000000*  *1.4142135" "$work/out")" -eq 2 ]'
sed -i "s/, T=.*/, L='exp(t) (m\/2 (x_dot^2+y_dot^2) - k\/2 (x^2 + y^2))' \//" "$work/said/plane.nml"
run describe "$work/said/plane.nml"
check "a factor of time before L is a drag" grep -q 'accelerations depend on positions and velocities, though the time is in L$' "$work/out"
refuses 2 "M and K, the second derivatives of L, contain the time" modes "$work/said/plane.nml"
refuses 2 "M and K, the second derivatives of L, contain the time" modes "$work/said/plane.nml" --set plane%m=1e-20 --set plane%k=2e-20
sed -i "s/, L=.*/, L='-m k^2 sqrt(1 - (x_dot^2 + y_dot^2)\/k^2) - k\/2 (x^2 + y^2)' \//" "$work/said/plane.nml"
run derive "$work/said/plane.nml"
check "derive: the root of 1 is 1" eval '[ $status -eq 0 ] && grep -q "^   M11 = m$" "$work/out" && ! grep -q "sqrt(1)" "$work/out"'
run derive double_pendulum --latex
check "derive --latex: formulas in its remarks are formulas" eval '[ $status -eq 0 ] && grep -qF "about \$\theta_{1} = 0\$, \$\theta_{2} = 0\$: \$M \ddot{q} + K q = 0\$ with\par" "$work/out"'
run derive cart_pendulum --latex
check "derive --latex: of a cyclic coordinate" grep -qF '$x$ is cyclic: $\partial L/\partial\dot{x}$ is conserved\par' "$work/out"
run describe atwood_lift
check "a support that accelerates evenly is a constant force" eval 'grep -q "^  1 degree of freedom; accelerations depend on positions only, though the time is in L" "$work/out" && ! grep -q "and on the time" "$work/out"'
refuses 2 "the equation of motion of this driven_pendulum contains the time" modes driven_pendulum
for place in 1e12 1e14 1e16 1e300; do refuses 2 "not an equilibrium of pendulum" modes pendulum --at $place; done
refuses 2 "; the nearest is 0.0" modes oscillator --at 1e-3
said "equilibrium='1','1'"
run modes "$work/said/plane.nml"
check "an equilibrium that rounding has left is 0" grep -q 'about x = 0.0, y = 0.0' "$work/out"
check "one that a scene states and is none is told" grep -q "the scene's equilibrium, x = 1.0, y = 1.0, is none" "$work/err"
run run bouncing_ball --set scene%period_of=y --output "$work/said"
check "flights that become shorter have no period" eval '[ $status -eq 0 ] && grep -q "^    no period: from one lower turning point to the next it is " "$work/out" && ! grep -q "measured" "$work/out"'
run run pendulum --set scene%period_of=theta --output "$work/said"
check "a swing has one" grep -q '^    period  *[0-9.]* s  *measured$' "$work/out"

# Differences, errors and drifts have no sign
for words in "modes hanging_chain --set hanging_chain%n=13" "modes double_pendulum" "principle action" "principle gauss-hertz" "principle least-time" check "run pendulum sphere oscillator cart_pendulum --error-estimate --output $work/o"; do
    # shellcheck disable=SC2086
    run $words
    case $words in
        modes*) signed='^.{95}-[0-9]' ;;
        principle*) signed=' -[0-9.]+(E[-+][0-9]+)? +[^ ]+ (holds|differs)$' ;;
        check) signed=' -[0-9.]+E[^ ]+ +.*(holds|FAILS)$' ;;
        *) signed='^[a-z_]+ +[a-z0-9]+ .* -[0-9].*(holds|-)$' ;;
    esac
    check "${words%% *}: no column of differences has a sign" eval '[ $status -eq 0 ] && [ "$(grep -cE "(holds|oscillation|-)\$" "$work/out")" -gt 1 ] && ! grep -E -- "$signed" "$work/out"'
done

check "no line that is printed ends with a blank: $(sort -u "$work/blanks" 2>/dev/null | head -n 3 | tr '\n' ';')" [ ! -s "$work/blanks" ]

echo "$count claims, $failures failed"
exit $((failures > 0))
