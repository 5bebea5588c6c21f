#!/usr/bin/env bash
# Signals at any moment, kill -9, two runs of one file, gnuplot that is missing, fails or hangs: nothing is left
# half-written, what was there survives, the status is right. Usage: attack_signals.sh [PROGRAM]; takes some seconds.
set -u
source "$(dirname "$0")/attack_tools.sh"

# A script that was started in the background ignores SIGINT, and so would its children
heard=(env --default-signal=HUP,INT,QUIT,TERM,XCPU,USR1,USR2,ALRM,VTALRM,PROF)
"${heard[@]}" true 2>/dev/null || heard=()

endings="HUP:129 INT:130 QUIT:131 TERM:143 XCPU:152"
rarer="" # what else ends a program that does not catch it, by this system's numbers
for name in USR1 USR2 ALRM VTALRM PROF IO POLL PWR STKFLT RTMIN RTMAX; do
    case $(uname) in Linux) ;; *) case $name in IO | POLL | PWR | STKFLT | RT*) continue ;; esac ;; esac
    number=$(kill -l $name 2>/dev/null) && rarer="$rarer $name:$((128 + number))"
done
ended() { # ended SIGNAL: send it to the child; its status. One that hangs is killed
    kill -"$1" $child
    for _ in $(seq 100); do
        kill -0 $child 2>/dev/null || break
        sleep 0.05
    done
    kill -KILL $child 2>/dev/null
    wait $child 2>/dev/null
    status=$?
}

# Signals in the middle, kill -9, two runs of one file
begin() { # begin FOLDER: a long run in the background; returns when its temporary is there
    ${heard[@]+"${heard[@]}"} "$program" run pendulum --set scene%output=pendulum --set scene%duration=1e6 --set scene%every=1000 --output "$1" >"$work/out" 2>"$work/err" &
    child=$!
    for _ in $(seq 200); do
        leftovers "$1" 2>/dev/null || return
        sleep 0.02
    done
}
set -m # else a shell lets its background jobs ignore SIGINT
for pair in $endings $rarer KILL:137; do
    mkdir "$work/${pair%:*}"
    plant "$work/${pair%:*}" pendulum.dat pendulum.gp
    begin "$work/${pair%:*}"
    ended "${pair%:*}"
    check "SIG${pair%:*}: status ${pair#*:}, the old files live" eval '[ $status -eq '"${pair#*:}"' ] && unharmed "$work/${pair%:*}" pendulum.dat pendulum.gp'
    [ "${pair%:*}" = KILL ] || check "SIG${pair%:*}: one line, no temporary" eval 'one_line && leftovers "$work/${pair%:*}"'
done
run run pendulum --output "$work/alone"
check "SIGKILL leaves a hidden temporary" eval '! leftovers "$work/KILL"'
run run pendulum --output "$work/KILL"
check "the next run removes it, and writes the same bytes as in a folder of its own" eval '[ $status -eq 0 ] && diff -r "$work/alone" "$work/KILL"'
begin "$work/KILL"
run run pendulum --output "$work/KILL"
check "a run beside a longer one of the same file: the same bytes, and the other's temporary stays" eval '[ $status -eq 0 ] && cmp "$work/alone/pendulum.dat" "$work/KILL/pendulum.dat" && ! leftovers "$work/KILL"'
ended TERM
check "until that one ends" leftovers "$work/KILL"

for _ in 1 2 3 4; do
    "$program" run pendulum --quiet --output "$work/both" 2>"$work/err" &
done
wait
check "four runs into one file: it is whole" eval 'diff -r "$work/alone" "$work/both"'

# A sweep: what is complete stays, and --resume gives the bytes of a sweep that nobody ended
diagram=(sweep bifurcation --set scene%output=bifurcation --over f=1:1.5:300)
kept() { # how many bytes of the sweep
    stat -c %s "$work/sweep/${diagram[1]}_sweep.dat.part" 2>/dev/null || echo 0
}
begin_sweep() { # begin_sweep WORDS...: in the background; returns when 10,000 bytes more are kept, of some 170,000
    local before=$(kept)
    ${heard[@]+"${heard[@]}"} "$program" "${diagram[@]}" --output "$work/sweep" "$@" >"$work/out" 2>"$work/err" </dev/null &
    child=$!
    for _ in $(seq 1000); do
        [ "$(kept)" -gt $((before + 10000)) ] && return
        kill -0 $child 2>/dev/null || return
        sleep 0.02
    done
}
workers() { # the processes that compute for it
    cat "/proc/$child/task/$child/children"
}
run "${diagram[@]}" --output "$work/whole"
check "a sweep that nobody ends" eval '[ $status -eq 0 ] && leftovers "$work/whole" && [ ! -e "$work/whole/bifurcation_sweep.dat.part" ]'
begin_sweep --threads 2
others=$(workers)
ended KILL
for _ in $(seq 100); do kill -0 $others 2>/dev/null || break; sleep 0.1; done
check "sweep: the processes that compute end with it" eval '[ -n "$others" ] && ! kill -0 $others 2>/dev/null'
check "sweep: kill -9 leaves what is complete" eval '[ $status -eq 137 ] && [ -s "$work/sweep/bifurcation_sweep.dat.part" ] && [ ! -e "$work/sweep/bifurcation_sweep.dat" ]'
run "${diagram[@]}" --output "$work/sweep"
check "sweep: not begun anew over that" eval '[ $status -eq 5 ] && one_line && grep -q -- --resume "$work/err"'
run sweep bifurcation --set scene%output=bifurcation --over f=1:1.5:301 --output "$work/sweep" --resume
check "sweep: --resume of another sweep is refused" eval '[ $status -eq 5 ] && one_line && grep -q "another sweep" "$work/err"'
begin_sweep --resume --threads 1
ended KILL
begin_sweep --resume --threads 2
others=$(workers)
kill -KILL ${others%% *}
wait $child
status=$?
check "sweep: a process that computes is killed" eval '[ $status -eq 4 ] && one_line && grep -q "signal 9: .* trajectories are kept in .*--resume" "$work/err"'
begin_sweep --resume --threads 3
ended INT
check "sweep: SIGINT says what is kept" eval '[ $status -eq 130 ] && one_line && grep -q "trajectories are kept in" "$work/err"'
cp "$work/sweep/bifurcation_sweep.dat.part" "$work/part"
printf x | dd of="$work/sweep/bifurcation_sweep.dat.part" bs=1 seek=30000 conv=notrunc 2>/dev/null
run "${diagram[@]}" --output "$work/sweep" --resume
check "sweep: --resume of a damaged file keeps what is sound" eval '[ $status -eq 0 ] && grep -q "damaged at byte .* sound blocks are kept, the other .* computed again" "$work/err" && diff -r "$work/whole" "$work/sweep"'
rm "$work/sweep"/*
cp "$work/part" "$work/sweep/bifurcation_sweep.dat.part"
run "${diagram[@]}" --output "$work/sweep" --resume
check "sweep: twice killed and once interrupted, the bytes are the same, and nothing else is left" eval '[ $status -eq 0 ] && diff -r "$work/whole" "$work/sweep" && leftovers "$work/sweep"'
run "${diagram[@]}" --output "$work/sweep" --resume
check "sweep: nothing to resume" eval '[ $status -eq 5 ] && one_line && diff -r "$work/whole" "$work/sweep"'
for bytes in 0 100; do
    rm "$work/sweep"/*
    head -c $bytes "$work/part" >"$work/sweep/bifurcation_sweep.dat.part"
    run "${diagram[@]}" --output "$work/sweep" --resume
    check "sweep: killed when $bytes bytes were written, it can be resumed" eval '[ $status -eq 0 ] && diff -r "$work/whole" "$work/sweep"'
done
rm "$work/sweep"/*
(ulimit -n 5; exec "$program" "${diagram[@]}" --threads 1 --output "$work/sweep") >"$work/out" 2>"$work/err" </dev/null
status=$?
check "sweep: where the table cannot be written, all trajectories are kept" eval '[ $status -eq 5 ] && one_line && grep -q "; all trajectories are kept in .*--resume" "$work/err"'
run "${diagram[@]}" --output "$work/sweep" --resume
check "sweep: and --resume writes it" eval '[ $status -eq 0 ] && diff -r "$work/whole" "$work/sweep"'

(ulimit -n 4; exec "$program" run pendulum --output "$work/few") >"$work/out" 2>"$work/err" </dev/null
status=$?
check "ulimit -n 4: status 5, and why" eval '[ $status -eq 5 ] && grep -q "cannot write .*: Too many open files" "$work/out" "$work/err" && ! grep -q "Bad file" "$work/out" "$work/err"'

# In lanes, by dop853, each trajectory with its own mass and to its own end
diagram=(sweep double_pendulum --set scene%output=double_pendulum --set "scene%method='dop853'" --set scene%tolerance=1e-9 --set scene%samples=1 --set scene%duration=60 --over m1=0.5:2:100 --over theta1=1:3:60 --keep theta2)
rm -r "$work/whole" "$work/sweep"
run "${diagram[@]}" --output "$work/whole"
check "a sweep by dop853 in lanes that nobody ends" eval '[ $status -eq 0 ] && grep -q "by dop853 .*, in lanes" "$work/out" && leftovers "$work/whole"'
for words in "--threads 2" "--resume --threads 1"; do
    begin_sweep $words
    ended KILL
    check "in lanes: kill -9, $words, leaves what is complete" eval '[ $status -eq 137 ] && [ "$(kept)" -gt 10000 ] && [ ! -e "$work/sweep/double_pendulum_sweep.dat" ]'
done
run "${diagram[@]}" --output "$work/sweep" --resume --threads 2
check "in lanes: twice killed, the bytes are the same, and nothing else is left" eval '[ $status -eq 0 ] && grep -q "were there already" "$work/out" && diff -r "$work/whole" "$work/sweep" && leftovers "$work/sweep"'

# A signal in the middle of any command: it ends within seconds, whatever it is at
begin_command() { # begin_command WORDS...: in the background; returns when it catches signals
    ${heard[@]+"${heard[@]}"} "$program" "$@" >"$work/out" 2>"$work/err" </dev/null &
    child=$!
    for _ in $(seq 200); do # the last digit of the mask: 2 stands for SIGINT
        [ "$(readlink "/proc/$child/exe")" = "$program" ] && grep -qs '^SigCgt:.*[2367abef]$' "/proc/$child/status" && return
        sleep 0.01
    done
}
for signal in $endings USR1:$((128 + $(kill -l USR1))) ALRM:142; do
    for writer in "modes hanging_chain --set hanging_chain%n=1000 --output" "principle action --output" \
        "bench --quick --output" "run double_pendulum --set scene%duration=1e5 --error-estimate --output" stress check; do
        folder=$work/${signal%:*}${writer%% *}
        case $writer in
            *--output) begin_command $writer "$folder" ;;
            *) begin_command $writer ;;
        esac
        ended "${signal%:*}"
        check "$writer: SIG${signal%:*} ends it, status ${signal#*:}" eval '[ $status -eq ${signal#*:} ] && only_ours && { [ ! -e "$folder" ] || leftovers "$folder"; }'
    done
    folder=$work/many${signal%:*}
    begin_command modes hanging_chain --set hanging_chain%n=200 --output "$folder"
    for _ in $(seq 400); do
        [ -e "$folder/hanging_chain_n_200_mode_2.dat" ] && break
        sleep 0.02
    done
    ended "${signal%:*}"
    check "modes: SIG${signal%:*} between two of many files: each is whole" eval '[ $status -eq ${signal#*:} ] && leftovers "$folder" && [ "$(wc -l "$folder"/*.dat | sed "/total/d" | awk "{ print \$1 }" | sort -u | wc -l)" -eq 1 ]'
done

# The program's own clock runs out: SIGXCPU from the system, once a second
mkdir "$work/clock"
plant "$work/clock" pendulum.dat
(ulimit -S -t 1; exec timeout 120 "$program" run pendulum --set scene%output=pendulum --set scene%duration=1e6 --set scene%every=1000 --output "$work/clock" >"$work/out" 2>"$work/err" </dev/null)
status=$?
check "ulimit -t: status 152, said at the end, the old file lives" eval '[ $status -eq 152 ] && only_ours && [ "$(tail -n 1 "$work/err")" = "lagrangia: interrupted" ] && unharmed "$work/clock" pendulum.dat && leftovers "$work/clock"'

# A run of days off a terminal says so on stderr, once; --json stays JSON, --quiet stays quiet
for words in "" --json --quiet; do
    : >"$work/err" # what an earlier command said must not end the wait
    ${heard[@]+"${heard[@]}"} "$program" run pendulum --set scene%output=pendulum --set scene%duration=1e9 --set scene%every=1000000 $words --output "$work/days" >"$work/out" 2>"$work/err" </dev/null &
    child=$!
    for _ in $(seq $([ "$words" = --quiet ] && echo 100 || echo 400)); do
        [ -s "$work/err" ] && break
        sleep 0.05
    done
    ended TERM
    check "a run of days $words: how long it takes is said" eval 'case $words in --quiet) one_line ;; *) [ "$(wc -l <"$work/err")" -eq 2 ] && grep -q "^lagrangia: pendulum takes about [0-9]* \(h\|days\)$" "$work/err" && ! grep -q about "$work/out" ;; esac'
done
: >"$work/err"
${heard[@]+"${heard[@]}"} "$program" check hanging_chain --set hanging_chain%n=1000 >"$work/out" 2>"$work/err" </dev/null &
child=$!
for _ in $(seq 400); do
    [ -s "$work/err" ] && break
    sleep 0.05
done
ended TERM
check "check of a long chain: how long it takes is said" grep -q "^lagrangia: the audit of hanging_chain with 1000 coordinates takes about [0-9]* [a-z]*$" "$work/err"

# So does a sweep, long before its first trajectory is done: in the lanes of registers, and one by one
for kept in theta period; do
    : >"$work/err"
    ${heard[@]+"${heard[@]}"} "$program" sweep pendulum --set scene%dt=1e-11 --set scene%output=slow --over theta=0.1:0.2:10 --keep $kept --output "$work/days" >"$work/out" 2>"$work/err" </dev/null &
    child=$!
    for _ in $(seq 400); do
        grep -q about "$work/err" && break
        sleep 0.05
    done
    ended TERM
    check "a sweep of $kept of 10 trajectories of 10^12 steps: how long it takes is said" grep -q "^lagrangia: pendulum takes about [0-9]* \(h\|days\|years\)$" "$work/err"
done

# Little stack, little memory: the command works, or says in one line what it lacks; it never hangs
in_little() { # in_little LIMIT... -- WORDS...: OpenBLAS is left to its own devices
    local limit=()
    while [ "$1" != -- ]; do limit+=("$1"); shift; done
    shift
    (ulimit "${limit[@]}"; exec env -u OPENBLAS_NUM_THREADS timeout 600 "$program" "$@" >"$work/out" 2>"$work/err" </dev/null)
    status=$?
}
deep=$(printf 'sin( %.0s' {1..190})x$(printf ' )%.0s' {1..190})
printf "&scene system = 'deep', dt = 0.01, duration = 1.0, q = 0.5 /\n&lagrangian coordinates = 'x', T = 'x_dot^2/2', V = '%s' /\n" "$deep" >"$work/deep.nml"
for writer in "run $work/deep.nml --output" "derive $work/deep.nml --set scene%dt=0.1" "modes $work/deep.nml --output" "describe $work/deep.nml --set scene%dt=0.1"; do
    in_little -s 2048 -- ${writer/%--output/--output $work/little}
    check "${writer%% *} of 190 brackets within each other: 2048 kB of stack are enough" eval '[ $status -eq 0 ] || { [ $status -eq 2 ] && one_line; }'
done
for writer in "run double_pendulum --output" "run hanging_chain --output" "modes hanging_chain --output" "principle action --output" "bench --quick --quiet --output"; do
    in_little -s 2048 -- $writer "$work/little"
    check "$writer: 2048 kB of stack are enough" eval '[ $status -eq 0 ] && [ ! -s "$work/err" ]'
    in_little -s 256 -- $writer "$work/little"
    check "$writer: 256 kB of stack are not" eval '[ $status -eq 4 ] && one_line && grep -q "ulimit -s 8192" "$work/err"'
done
for memory in 100000 140000 180000 200000; do
    for writer in list "modes double_pendulum" "check pendulum"; do
        in_little -v $memory -- $writer
        check "$writer: ulimit -v $memory: works or says what it lacks" eval '[ $status -eq 0 ] || { [ $status -eq 4 ] && one_line && grep -q "not enough memory" "$work/err"; }'
    done
done
for memory in 220000 225000 230000; do
    in_little -v $memory -- modes hanging_chain --set hanging_chain%n=600
    check "modes of 600 coordinates: ulimit -v $memory is not enough, and that is said" eval '[ $status -eq 4 ] && one_line && grep -q "not enough memory: the eigenproblem of 600 coordinates needs 58 MB" "$work/err"'
done
in_little -v 300000 -- modes hanging_chain --set hanging_chain%n=600
check "modes of 600 coordinates: ulimit -v 300000 is enough" eval '[ $status -eq 0 ] && [ "$(grep -c "oscillation$" "$work/out")" -eq 600 ]'
in_little -v 250000 -- modes double_pendulum
check "modes double_pendulum: ulimit -v 250000 is enough" eval '[ $status -eq 0 ]'

# Pictures: gnuplot that is missing, fails, stops half-way or hangs; and the disk that is full when it draws
fake() { # fake LINES: a gnuplot of our own; its fifth word is the file to draw into
    mkdir -p "$work/bin"
    printf '%s\n' '#!/bin/sh' "$@" >"$work/bin/gnuplot"
    chmod +x "$work/bin/gnuplot"
}
drawn_badly() { # drawn_badly CLAIM: status 5, the last line is ours; data and script are new, the old picture lives
    check "$1" eval '[ $status -eq 5 ] && tail -n 1 "$work/err" | grep -q "^lagrangia: .*gnuplot" && diff -r -x "*.svg" "$work/alone" "$work/drawn" && unharmed "$work/drawn" pendulum.svg && leftovers "$work/drawn"'
}
mkdir "$work/drawn" "$work/nothing"
plant "$work/drawn" pendulum.svg
plot=(run pendulum --plot=svg --output "$work/drawn")
real_path=$PATH
timeout=$(command -v timeout)
PATH=$work/nothing "$timeout" 120 "$program" "${plot[@]}" >"$work/out" 2>"$work/err" </dev/null
status=$?
drawn_badly "--plot: there is no gnuplot"
PATH=$work/bin:$PATH
fake 'exit 3'
run "${plot[@]}"
drawn_badly "--plot: gnuplot fails"
fake 'echo "<svg>" >"$5"; kill -SEGV $$'
run "${plot[@]}"
drawn_badly "--plot: gnuplot dies"
fake 'echo "<svg>" >"$5"'
run "${plot[@]}"
drawn_badly "--plot: gnuplot stops half-way, and says that all is well"
fake 'echo "$4 <svg></svg> 20 bytes" >"$5"'
run "${plot[@]}"
check "--plot: a whole picture has its name" eval '[ $status -eq 0 ] && grep -q "^svg" "$work/drawn/pendulum.svg" && leftovers "$work/drawn"'
plant "$work/drawn" pendulum.svg
fake "echo \$\$ >'$work/gnuplot'" 'echo "<svg>" >"$5"' 'exec sleep 30'
for signal in $endings $rarer; do
    rm -f "$work/gnuplot"
    begin_command "${plot[@]}"
    for _ in $(seq 200); do
        [ -s "$work/gnuplot" ] && break
        sleep 0.02
    done
    ended "${signal%:*}"
    check "--plot: SIG${signal%:*} while gnuplot draws ends both, status ${signal#*:}" eval '[ $status -eq ${signal#*:} ] && one_line && unharmed "$work/drawn" pendulum.svg && leftovers "$work/drawn" && ! kill -0 "$(cat "$work/gnuplot")"'
done
PATH=$real_path
mkdir "$work/disk"
if command -v gnuplot >/dev/null && [ "$(id -u)" -eq 0 ] && mount -t tmpfs -o size=256k none "$work/disk" 2>/dev/null; then
    disk=$work/disk # has room for the data, and for half of the picture
    plant "$disk" pendulum.svg
    run run pendulum --plot=svg --output "$disk"
    check "--plot: the disk is full when gnuplot draws" eval '[ $status -eq 5 ] && one_line && grep -q "no space left" "$work/err" && unharmed "$disk" pendulum.svg && diff -r -x "*.svg" "$work/alone" "$disk" && leftovers "$disk"'
else
    echo "skipped a disk that is full when gnuplot draws: no gnuplot, or no tmpfs may be mounted here"
fi

summary
