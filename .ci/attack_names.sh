#!/usr/bin/env bash
# Files under attack: names of one file, runs that fail over a good file, disks that fill during a run.
# Nothing is read and written at once, no good file is lost, and nobody computes for a disk that is full.
# Usage: attack_names.sh [PROGRAM]; takes some seconds.
set -u
source "$(dirname "$0")/attack_tools.sh"
cd "$work" || exit 2

scene() { # scene FILE KEYS...: a short run
    printf "&scene system='pendulum' dt=1e-2 duration=1 q=1 %s /\n" "${*:2}" >"$1"
}
sum() { find . -path ./data -prune -o \( -name out -o -name err \) -prune -o -type f -print0 | sort -z | xargs -0 md5sum; }
refused() { # refused CLAIM WORDS...: status 2, one line, not a file changed; nothing ran
    local before
    before=$(sum)
    run "${@:2}"
    after=$(sum)
    check "$1" eval '[ $status -eq 2 ] && one_line && [ "$before" = "$after" ] && [ ! -s "$work/out" ]'
}

# Two names, one file: each of these lost a file once
mkdir s o
scene s/c_events.nml "output='c.nml' event='theta'"
refused "the events' file would be the scene" run s/c_events.nml --output s
scene s/c_events.dat "output='c.dat' event='theta'"
refused "the same, whatever the ending" run ./s/c_events.dat --output "$work/s/../s"
scene s/a.nml "output='b.nml'"
scene s/b.nml "output='b'"
refused "the output of one would be the scene of another" run s/a.nml s/b.nml --output s
refused "a shipped scene that is not of the run" run pendulum --set "scene%output='atwood.nml'" --output data/scenes
for pair in s.dat:./s.dat s.dat:s x/s.dat:x/./s.dat s_events.dat:s; do
    scene s/p.nml "output='${pair%:*}'"
    scene s/q.nml "output='${pair#*:}' event='theta'"
    refused "outputs '${pair%:*}' and '${pair#*:}'" run s/p.nml s/q.nml --output o
done
for pair in s.csv:s.npy d.1:d.2; do # each has a script of its own
    scene s/p.nml "output='${pair%:*}'"
    scene s/q.nml "output='${pair#*:}' event='theta'"
    run run s/p.nml s/q.nml --output o
    check "outputs '${pair%:*}' and '${pair#*:}': both, with two scripts" eval \
        '[ $status -eq 0 ] && [ "$(ls o/"${pair%:*}"*.gp o/"${pair#*:}"*.gp | wc -l)" -ge 2 ]'
    rm -f o/*
done
scene s/e.nml "output='c_events.dat'"
scene s/f.nml "output='c' event='theta'"
refused "an event file called as another's data" run s/e.nml s/f.nml --output o
refused "the other way round" run s/f.nml s/e.nml --output o
for ending in png svg pdf gp nml partial dat.partial; do
    refused "output='x.$ending'" run s/f.nml --set "scene%output='x.$ending'" --output o
done
refused "one scene twice" run pendulum data/scenes/pendulum.nml --output o
scene g.nml "output='g'"
ln g.nml h.nml
ln -s g.nml i.nml
refused "one scene by two hard links" run g.nml h.nml --output o
refused "one scene by a symbolic link" run g.nml ./i.nml --output o
for kind in "" -s; do
    for name in g.dat g.gp g.png g.svg g.pdf g.dat.partial; do
        ln $kind "$work/g.nml" "o/$name"
        refused "the scene is linked (ln $kind) as $name" run g.nml --output o
        rm "o/$name"
    done
done
echo old >o/g.dat
for other in g.gp g.png g.dat.partial; do
    ln -s g.dat "o/$other"
    refused "$other is a link to the data file" run g.nml --output o
    rm "o/$other"
done
rm o/g.dat
mkdir o/real
ln -s real o/way
scene s/p.nml "output='real/p'"
scene s/q.nml "output='way/p'"
refused "two names of one folder" run s/p.nml s/q.nml --output o
rm -r o/real o/way
for writer in "principle least-time:principle_least_time" "modes double_pendulum:double_pendulum_mode_1" \
    "bench precision --quick --quiet --problems P1 --methods rk4:bench"; do
    name=${writer#*:}
    echo old >"o/$name.dat"
    ln -s "$name.dat" "o/$name.gp"
    run ${writer%:*} --output o
    check "${writer%%:*}: the script is a link to the data" eval '[ $status -eq 2 ] && one_line && [ "$(cat o/$name.dat)" = old ]'
    rm o/*
done
# The scene that any other command reads is none of the files that it writes
for kind in -s ""; do
    for words in "modes@g_mode_1.dat" "modes@g_mode_1.gp" "modes --plot@g_modes.dat" "modes --animate@g_modes.html" \
        "bench precision steps --quick --problems P1 --methods rk4 --systems@bench.dat" "report@report.html" "report@g.svg" \
        "compare --methods rk4,gauss16@g_rk4.dat" "compare --methods rk4,gauss16@g_methods.gp" \
        "sweep --over q=1:2:2 --keep theta@g_sweep.dat" "sweep --over q=1:2:2 --keep theta@g_sweep.dat.part" \
        "sweep --over q=1:2:2 --keep theta --resume@g_sweep.dat.part"; do
        ln $kind "$work/g.nml" "o/${words#*@}"
        refused "${words%@*}: the scene is linked (ln $kind) as ${words#*@}" ${words%@*} ./g.nml --output o
        check "${words%@*}: the line names both" grep -q "'o/${words#*@}'.* and the scene './g.nml' are one file: one would be lost" err
        rm o/*
    done
done
# A scene that somebody else has written is not overwritten by the one that lies beside csv and npy
for words in "run@g.csv" "sweep --over q=1:2:2 --keep theta@g_sweep.csv"; do
    echo "&scene /" >"o/${words#*@}.nml"
    run ${words%@*} g.nml --format csv --output o
    check "${words%@*} --format csv: a scene of the user's is kept" eval '[ $status -eq 2 ] && one_line && [ "$(cat "o/${words#*@}.nml")" = "&scene /" ]'
    rm o/*
    run ${words%@*} g.nml --format csv --output o
    run ${words%@*} g.nml --format csv --output o
    check "${words%@*} --format csv: and one of ours is written again" eval '[ $status -eq 0 ] && [ -s "o/${words#*@}.nml" ]'
    rm o/*
done
# and these are two files
long=$(printf 'n%.0s' $(seq 40))
scene "${long}x.nml"
scene "${long}y.nml"
run run "${long}x.nml" "${long}y.nml" --output o
check "names of 41 letters that differ in the last" eval '[ $status -eq 0 ] && [ -s o/${long}x.dat ] && [ -s o/${long}y.dat ]'
very=$(printf 'n%.0s' $(seq 200))
scene "$very.nml"
run run "$very.nml" --output o
check "a name of 200 letters" eval '[ $status -eq 0 ] && [ -s o/$very.dat ] && grep -q "output = .$very." o/$very.dat'
rm o/*
scene s/p.nml "output='p'"
scene s/q.nml "output='P'"
run run s/p.nml s/q.nml --output s
check "capitals differ, and the scenes' own folder will do" eval '[ $status -eq 0 ] && [ -s s/p.dat ] && [ -s s/P.dat ] && grep -q pendulum s/p.nml'
for name in gp png nml; do
    run run g.nml --set "scene%output='$name'" --output o
    check "output='$name' is a name like others" eval '[ $status -eq 0 ] && [ -s o/$name.dat ]'
done

# A run that fails leaves the good file; what was good of it is NAME.partial
rm -r o
printf "&scene system='oscillator' method='verlet' dt=10 duration=10000 every=1 q=1 event='x' columns='t','x' output='b' /\n" >blow.nml
for pair in text:dat csv:csv npy:npy; do
    ending=${pair#*:}
    mkdir o
    plant o b.$ending b.gp b_events.$ending b_events.gp
    run run blow.nml --quiet --format "${pair%:*}" --output o
    check "$ending: a run that fails: status 3, a line that names the part" eval '[ $status -eq 3 ] && one_line && grep -q "o/b.$ending.partial" err'
    check "$ending: the old files live" eval 'unharmed o b.$ending b.gp b_events.$ending b_events.gp && leftovers o'
    check "$ending: beside them is what was good" eval '[ -s o/b.$ending.partial ] && [ -s o/b_events.$ending.partial ] && [ "$(ls o | wc -l)" = 6 ]'
    run run blow.nml --quiet --format "${pair%:*}" --set scene%output=b --set scene%dt=0.1 --set scene%duration=10 --output o
    check "$ending: a run that succeeds removes it" eval '[ $status -eq 0 ] && ! ls o | grep -q partial && ! unharmed o b.$ending'
    rm -r o
done
run run blow.nml --quiet --output o
check "the part says where and why" eval 'grep -Eq "^# PARTIAL, rows: [0-9]+; the run ended at t = [0-9.]+ s after [0-9]+.* steps: the state is not finite" o/b.dat.partial && ! grep -q "^# steps" o/b.dat.partial'
check "no script or picture claims to draw it" eval '[ "$(ls o | tr "\n" " ")" = "b.dat.partial b_events.dat.partial " ]'
run run blow.nml --json --output o
check "--json names the part" eval 'grep -q "\"file\": \"o/b.dat.partial\"" out && [ $status -eq 3 ]'
mkdir o/b.csv.partial
run run blow.nml --quiet --format csv --output o
check "a folder has the name of the part" eval '[ $status -eq 3 ] && one_line && grep -q "Is a directory" err && leftovers o'

# A disk that fills during a run that would take minutes
minutes=(run pendulum --set scene%output=pendulum --set scene%duration=1e6 --set scene%dt=1e-3 --output)
soon() { # soon CLAIM: the run above ended with status 5 within seconds, and left nothing
    check "$1" eval '[ $status -eq 5 ] && [ $seconds -le 5 ] && grep -q "cannot write" err && leftovers "$folder"'
}
timed() {
    seconds=$SECONDS
    (ulimit -f "$1"; timeout 60 "$program" "${@:2}" >"$work/out" 2>"$work/err" </dev/null)
    status=$?
    seconds=$((SECONDS - seconds))
}
folder=$work/limit
timed 100 "${minutes[@]}" "$folder" --set scene%every=1
soon "ulimit -f, many rows"
timed 1 "${minutes[@]}" "$folder" --set scene%every=100000000
soon "ulimit -f, no room for the header"
mkdir gone
(sleep 1; rm -r gone) &
folder=$work
timed 1000000 "${minutes[@]}" gone --set scene%every=1000
soon "the folder is removed"
if [ "$(id -u)" -eq 0 ] && mkdir disk && mount -t tmpfs -o size=1m none disk 2>/dev/null; then
    disk=$work/disk folder=$work/disk
    plant disk pendulum.dat pendulum.gp
    timed unlimited "${minutes[@]}" disk --set scene%every=1
    soon "a disk of 1 MB"
    check "a disk of 1 MB: the old files live" unharmed disk pendulum.dat pendulum.gp
    (sleep 1; head -c 2M /dev/zero >disk/filler) 2>/dev/null &
    timed unlimited "${minutes[@]}" disk --set scene%every=20000
    soon "somebody else fills the disk"
    wait
    head -c 2M /dev/zero >disk/filler 2>/dev/null
    for words in "bench" "modes hanging_chain --set hanging_chain%n=300" "run --set scene%output=pendulum --set scene%duration=1e6 pendulum"; do
        timed unlimited $words --output disk
        soon "$words: a full disk is known before"
    done
    for words in "check --json" "stress --json" "bench steps --json"; do
        seconds=$SECONDS
        timeout 60 "$program" $words >disk/words 2>err
        status=$?
        seconds=$((SECONDS - seconds))
        soon "$words > a full disk"
    done
    rm disk/filler
    run modes hanging_chain --set hanging_chain%n=40 --output disk --quiet
    check "modes: one file too many: those before are whole" eval '[ $status -eq 5 ] && one_line && leftovers disk && [ "$(grep -L "^# rows: 201" disk/*mode*.dat | wc -l)" = 0 ]'
    mount -o remount,ro disk
    run run pendulum --output disk
    check "a read-only disk" eval '[ $status -eq 5 ] && grep -q "Read-only file system" err && unharmed disk pendulum.dat'
else
    echo "skipped a disk that fills: no tmpfs may be mounted here (ulimit -f stands in for it)"
fi

# What is much, or more than there is room for, is said before
run modes hanging_chain --set hanging_chain%n=50 --output few
check "2 MB of modes need no word" eval '[ $status -eq 0 ] && [ ! -s err ]'
timeout 2 "$program" modes hanging_chain --set hanging_chain%n=1000 --output much >out 2>err
check "5 GB of modes are said before they are looked for" grep -q "up to 5.0 GB are to be written" err
rm -r much
if [ -n "$disk" ]; then
    mount -o remount,rw,size=1m disk
    (timeout 30 "$program" modes hanging_chain --set hanging_chain%n=200 --output disk/new >out 2>err)
    check "modes: more than there is room for" grep -q "up to 202.0 MB are to be written, but only .* free in 'disk/new'" err
    (timeout 2 "$program" run pendulum --set scene%output=pendulum --set scene%duration=1e4 --set scene%every=1 --output disk/new >out 2>err)
    check "a run: more than there is room for" grep -q "are to be written, but only .* free in 'disk/new'" err
fi

# Files of one scene get their names together: where the last cannot be written, none is replaced
mkdir -p "$work/together/s.gp"
printf "&scene system='pendulum' dt=0.01 duration=3 q=1 event='theta = 0.5' event_columns='t' output='s' /" >"$work/together.nml"
plant "$work/together" s.dat s_events.dat
run run "$work/together.nml" --output "$work/together"
check "a script that cannot be written: data and events stay" eval '[ $status -eq 5 ] && unharmed "$work/together" s.dat s_events.dat && leftovers "$work/together"'
: >"$work/no_folder"
run run pendulum --output "$work/no_folder"
check "a run that could not begin has no error" eval '[ $status -eq 5 ] && ! grep -q "E+00\|exact *-" "$work/out"'
printf 'mine' >"$work/together/.lagrangia-t.dat-1.tmp"
run run pendulum --set scene%output=t --output "$work/together"
check "a user's file that is called as our temporaries stays" eval '[ $status -eq 0 ] && [ "$(cat "$work/together/.lagrangia-t.dat-1.tmp")" = mine ]'

summary
