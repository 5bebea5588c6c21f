#!/usr/bin/env bash
# Output under attack: full disks, closed and broken pipes, folders that refuse, odd names.
# Nothing is lost in silence, nothing is half-written, what was there survives, no shell is started,
# the status is right and the message one line. Usage: attack.sh [PROGRAM]; takes some seconds.
set -u
source "$(dirname "$0")/attack_tools.sh"

# Every command that writes: its words, and the files that it makes in the folder of --output
writers=("run pendulum" "modes double_pendulum" "compare pendulum --methods rk4,verlet" "principle least-time"
    "bench precision --quick --quiet --problems P1 --methods rk4" \
    "sweep pendulum --over theta=0:1:3 --keep theta" "run pendulum --animate" "modes pendulum --animate" "report pendulum")
makes=()
for writer in "${writers[@]}"; do
    rm -rf "$work/made"
    run $writer --output "$work/made"
    [ $status -eq 0 ] || head -n 3 "$work/err"
    makes+=("$(cd "$work/made" 2>/dev/null && ls | tr '\n' ' ')")
    check "$writer: works, one file at least" eval '[ $status -eq 0 ] && [ -n "${makes[-1]}" ]'
done

for i in "${!writers[@]}"; do
    writer=${writers[i]}
    echo data >"$work/file"
    run $writer --output "$work/file"
    check "$writer: the folder is a file" eval '[ $status -eq 5 ] && one_line && [ "$(cat "$work/file")" = data ]'
    run $writer --output /dev/full
    check "$writer: --output /dev/full" eval '[ $status -eq 5 ] && one_line && [ -c /dev/full ]'
    run $writer --output /proc/none
    check "$writer: a folder that cannot be made" eval '[ $status -eq 5 ] && one_line'
    run $writer --output ""
    check "$writer: --output without a name" eval '[ $status -eq 2 ] && one_line'
    run $writer --output "$(printf '%0300d' 0)"
    check "$writer: a name of 300 characters" eval '[ $status -eq 5 ] && one_line'
    mkdir -p "$work/deep"
    run $writer --output "$work/deep/$i/b/c"
    check "$writer: missing folders are made" eval '[ $status -eq 0 ] && [ "$(ls "$work/deep/$i/b/c" | tr "\n" " ")" = "${makes[i]}" ]'
    mkdir "$work/taken$i"
    (cd "$work/taken$i" && mkdir ${makes[i]})
    run $writer --output "$work/taken$i"
    check "$writer: the file is a folder" eval '[ $status -eq 5 ] && one_line && leftovers "$work/taken$i"'
    mkdir "$work/small$i"
    plant "$work/small$i" ${makes[i]}
    (ulimit -f 0; timeout 120 "$program" $writer --output "$work/small$i" >/dev/null 2>&1)
    status=$?
    check "$writer: no byte may be written; the old files live" eval '[ $status -eq 5 ] && unharmed "$work/small$i" ${makes[i]} && leftovers "$work/small$i"'
    for name in "a b" "it's" '"q"' '$(touch owned)' '`touch owned`' '; touch owned;' $'new\nline' -- '-dash' 'ä→'; do
        [ "$name" = -- ] && continue
        (cd "$work" && timeout 120 "$program" $writer "--output=$name" >"$work/out" 2>"$work/err" </dev/null)
        status=$?
        check "$writer: --output=$(printf %q "$name")" eval '[ $status -eq 0 ] && [ -d "$work/$name" ] && [ ! -e "$work/owned" ]'
        rm -rf "${work:?}/$name"
    done
    (set -o pipefail; timeout 120 "$program" $writer --output "$work/p" 2>"$work/err" >&-)
    status=$?
    case $writer in
        *--quiet*) ;;
        *) check "$writer: stdout is closed" eval '[ $status -eq 5 ] && one_line'
           timeout 120 "$program" $writer --output "$work/p" 2>"$work/err" >/dev/full
           status=$?
           check "$writer: stdout is full" eval '[ $status -eq 5 ] && one_line' ;;
    esac
done

# What may not be read or written: as root nothing is refused, so as nobody
user() { # user WORDS...: the program, run by somebody without privileges
    local who=(setpriv --reuid=65534 --regid=65534 --clear-groups)
    [ "$(id -u)" -eq 0 ] || who=()
    (cd "$work" && timeout 120 ${who[@]+"${who[@]}"} ./lagrangia "$@") >"$work/out" 2>"$work/err" </dev/null
    status=$?
}
forbidden() { # forbidden CLAIM FOLDER FILES...: refused, nothing harmed, nothing left
    local files=("${@:2}")
    check "$1" eval '[ $status -eq 5 ] && one_line && grep -q "$words" "$work/err" && unharmed "${files[@]}" && leftovers "${files[0]}"'
}
cp "$program" "$work/lagrangia"
rm -r "$work/data" # links into a home that may be closed to others
mkdir "$work/data"
cp -R data/scenes data/reference "$work/data"
chmod -R a+rX "$work"
user --version
if [ $status -eq 0 ]; then
    for i in "${!writers[@]}"; do
        writer=${writers[i]} folder=$work/user$i words="Permission denied"
        mkdir "$folder"
        plant "$folder" ${makes[i]}
        chmod 666 "$folder"/*
        chmod 555 "$folder"
        user $writer --output "$folder"
        forbidden "$writer: a read-only folder" "$folder" ${makes[i]}
        user $writer --output "$folder/new/folder"
        forbidden "$writer: a new folder in a read-only one" "$folder" ${makes[i]}
        chmod 666 "$folder"
        user $writer --output "$folder"
        chmod 777 "$folder"
        forbidden "$writer: a folder that may not be entered" "$folder" ${makes[i]}
        chmod 444 "$folder"/*
        user $writer --output "$folder"
        forbidden "$writer: read-only files" "$folder" ${makes[i]}
        if [ "$(id -u)" -eq 0 ]; then # where only its owner may rename a file
            chmod 666 "$folder"/*
            chmod 1777 "$folder"
            words="Operation not permitted"
            user $writer --output "$folder"
            forbidden "$writer: another's files in a sticky folder" "$folder" ${makes[i]}
            rm "$folder"/*
            echo theirs | tee $(printf "$folder/.lagrangia-%s-1.tmp " ${makes[i]}) >/dev/null
            user $writer --output "$folder"
            check "$writer: another's temporaries in a sticky folder are left alone" eval '[ $status -eq 0 ] && [ "$(cat "$folder"/.lagrangia-*-1.tmp | uniq)" = theirs ] && [ "$(ls "$folder" | tr "\n" " ")" = "${makes[i]}" ]'
        fi
    done
    mkdir "$work/closed"
    cp data/scenes/pendulum.nml "$work/closed"
    for mode in 000:755 644:000 666:644; do # of the file : of the folder
        chmod 755 "$work/closed"
        chmod "${mode%:*}" "$work/closed/pendulum.nml"
        chmod "${mode#*:}" "$work/closed"
        user run closed/pendulum.nml --output "$work/none"
        check "a scene that may not be read ($mode)" eval '[ $status -eq 5 ] && one_line && grep -q "closed/pendulum.nml: \(Permission denied\|the file cannot be opened; may it be read?\)" "$work/err" && [ ! -e "$work/none" ]'
        user grade closed/pendulum.nml
        check "a sheet that may not be read ($mode)" eval '[ $status -eq 5 ] && one_line && grep -q "closed/pendulum.nml: \(Permission denied\|the file cannot be opened; may it be read?\)" "$work/err"'
    done
    chmod 700 "$work/closed"
else
    echo "skipped what may not be read or written: root may everything, and nobody cannot be played here"
fi

# A disk that is full
mkdir "$work/disk"
if [ "$(id -u)" -eq 0 ] && mount -t tmpfs -o size=64k none "$work/disk" 2>/dev/null; then
    disk=$work/disk
    for i in "${!writers[@]}"; do
        plant "$disk" ${makes[i]}
        head -c 1M /dev/zero >"$disk/filler" 2>/dev/null
        run ${writers[i]} --output "$disk"
        check "${writers[i]}: the disk is full" eval '[ $status -eq 5 ] && one_line && unharmed "$disk" ${makes[i]} && leftovers "$disk"'
        rm "$disk"/*
    done
else
    echo "skipped a full disk: no tmpfs may be mounted here (ulimit -f stands in for it)"
fi

# The output is the scene itself
scene="&scene system='pendulum' output='me.nml' dt=1e-2 duration=1 q=1 /"
echo "$scene" >"$work/me.nml"
same() { [ "$(cat "$work/me.nml")" = "$scene" ]; }
run run "$work/me.nml" --output "$work"
check "the output is the scene" eval '[ $status -eq 2 ] && one_line && same'
for kind in -s ""; do
    mkdir -p "$work/l$kind"
    ln $kind "$work/me.nml" "$work/l$kind/me.nml"
    run run "$work/me.nml" --output "$work/l$kind"
    check "the output is a link (ln $kind) to the scene" eval '[ $status -eq 2 ] && one_line && same'
    mv "$work/l$kind/me.nml" "$work/l$kind/x.gp"
    run run "$work/me.nml" --output "$work/l$kind" --set scene%output=x.dat
    check "the script is a link (ln $kind) to the scene" eval '[ $status -eq 2 ] && one_line && same'
done
for odd in ../up /abs 'a/../../b' ''; do
    run run pendulum --output "$work/o" --set "scene%output='$odd'"
    check "scene%output='$odd' is refused" eval '[ $status -eq 2 ] && one_line && [ ! -e "$work/up.dat" ]'
done

# Texts that a shell, gnuplot, a terminal, JSON or a table might take for more than a text
inside() { # inside FOLDER WORDS...: the program, run there
    (cd "$1" && timeout 60 "$program" "${@:2}" >"$work/out" 2>"$work/err" </dev/null)
    status=$?
}
texts=('<touch owned;true ' '|touch owned;true ' '-x' '~root' '`touch owned`' '$(touch owned)' '@touch owned'
    "it's" "'Small' oscillations" "''" '"q"' '" ; system "touch owned" #' 'a\' '\140touch owned\140' 'a_b^{2} &c ~d'
    '50 %s %' '#' '!touch owned' '{/*9 x}' 'ä→' '$0 $h' 'a;b')
if command -v gnuplot >/dev/null; then
    for text in "${texts[@]}"; do
        inside "$work" run pendulum --plot=svg --quiet "--output=$text"
        check "--plot --output=$(printf %q "$text"): drawn, nothing is run" eval '[ $status -eq 0 ] && [ -s "$work/$text/pendulum.svg" ] && [ -z "$(find "$work" -name owned)" ]'
        rm -rf "$work/./$text/pendulum.png"
        (cd "$work/./$text" && timeout 120 gnuplot pendulum.gp >/dev/null 2>"$work/err")
        status=$?
        check "the same script, by hand" eval '[ $status -eq 0 ] && [ -s "$work/./$text/pendulum.png" ] && [ -z "$(find "$work" -name owned)" ]'
        rm -rf "$work/./$text"
        printf '%s\n' "&scene title='${text//\'/\'\'}' system='pendulum' dt=1e-2 duration=1 q=1 output='t' /" >"$work/title.nml"
        run run "$work/title.nml" --plot=svg --quiet --output "$work/titles"
        check "a title: $text" eval '[ $status -eq 0 ] && [ -z "$(find "$work" -name owned)" ] && python3 -c "import sys, xml.dom.minidom as m
sys.exit(sys.argv[2] not in [\"\".join(c.data for c in t.childNodes if c.data) for t in m.parse(sys.argv[1]).getElementsByTagName(\"text\") if all(c.nodeType == 3 for c in t.childNodes)])" "$work/titles/t.svg" "${text%"${text##*[! ]}"}"'
    done
    for writer in "modes double_pendulum" "compare pendulum --methods rk4,verlet" "run pendulum cart_pendulum --overlay" \
        "principle least-time" "bench precision --quick --quiet --problems P1 --methods rk4"; do
        for text in '<touch owned;true ' '|touch owned;true '; do
            inside "$work" $writer --plot "--output=$text"
            check "$writer --plot --output='$text': drawn, nothing is run" eval '[ $status -eq 0 ] && [ -n "$(find "$work/$text" -name "*.png")" ] && [ -z "$(find "$work" -name owned)" ]'
            rm -rf "${work:?}/$text"
        done
    done
fi
plain() { # no control character but the ends of lines, no byte that is not UTF-8
    python3 -c 'import sys, unicodedata
for name in sys.argv[1:]:
    if any(unicodedata.category(c) in ("Cc", "Cf", "Zl", "Zp") and c != "\n" for c in open(name, "rb").read().decode("utf-8")): sys.exit(name)' "$@"
}
odd=$'ev\e[31mil\nrow\xff\xc3\xc2\x9b\xe2\x80\xae.nml'
printf "&scene title='Schw\xfcnge \xc2\x9b31m \xe2\x80\xae' system='pendulum' dt=1e-2 duration=1 q=1 output='odd' /" >"$work/$odd"
inside "$work" run "$odd" --output "$work/odd"
check "a scene's odd name: nothing raw on stdout or stderr, two lines of the scorecard" eval '[ $status -eq 0 ] && plain "$work/out" "$work/err" "$work/odd/odd.dat" "$work/odd/odd.gp" && [ "$(grep -c "^ev.*row" "$work/out")" -eq 1 ]'
inside "$work" run "$odd" --json --output $'o\e\xff'
check "a scene's and a folder's odd name: JSON in UTF-8" eval '[ $status -eq 0 ] && plain "$work/out" "$work/err" && python3 -c "import json, sys; d = json.load(open(sys.argv[1], encoding=\"utf-8\")); sys.exit(d[0][\"scene\"][:3] != \"ev\" + chr(27))" "$work/out"'
inside "$work" run "$odd" --set scene%dt=-1
check "a scene's odd name in a refusal" eval '[ $status -eq 2 ] && one_line && plain "$work/err"'
for words in "run" "describe" "--" "--set" "run pendulum --format" "run pendulum --plot" "modes pendulum --at" "bench --tolerances"; do
    inside "$work" $words$([ "${words##* --}" = "$words" ] || echo =)$'\e]0;x\a\xff\xe2\x80\xae'
    check "an odd word behind '$words'" eval '[ $status -ne 0 ] && one_line && plain "$work/err" "$work/out"'
done
run run rotating_hoop atwood --output "$work/words"
check "a word a column in the last line of every header" eval '[ $status -eq 0 ] && for f in "$work"/words/*.dat; do [ "$(grep "^#" "$f" | tail -n 1 | wc -w)" -eq "$(($(tail -n 1 "$f" | wc -w) + 1))" ] || exit 1; done'
run run rotating_hoop --set "scene%columns='t','torque'" --set scene%plot=torque --output "$work/words"
check "a unit with a blank is one word" eval '[ $status -eq 0 ] && [ "$(grep "^#" "$work/words/rotating_hoop.dat" | tail -n 1)" = "# t[s] torque[N*m]" ]'

# Numbers that a table has no room for
run run oscillator_verlet --set scene%dt=1.5 --set scene%duration=15000 --set scene%every=1 --set oscillator%k=1e4 --output "$work/stars"
check "a failed run: no asterisks" eval '[ $status -eq 3 ] && ! grep -qF "**" "$work/out"'
run run oscillator_verlet --set oscillator%k=1e30 --set scene%dt=1e-17 --set scene%duration=1e-14 --set scene%modes=.true. --set scene%expect_energy_drift=1e-200 --output "$work/stars"
check "a fast oscillator: no asterisks" eval '! grep -qF "**" "$work/out" && grep -qF "1.0000000000E+15" "$work/out"'
for words in "modes pendulum --set pendulum%g=1e200" "modes pendulum --set pendulum%g=1e-250" "check rotating_hoop --set rotating_hoop%m=1e12" \
    "check pendulum --set pendulum%m=1e74 --set pendulum%g=1e-74"; do
    run $words
    check "$words: no asterisks" eval '[ -s "$work/out" ] && ! grep -qF "**" "$work/out"'
done
run run oscillator_verlet --json --set scene%dt=1.5 --set scene%duration=15 --set oscillator%k=4 --output "$work/stars"
check "--json carries the warning of the step limit" eval 'python3 -c "import json, sys; sys.exit(\"exceeds the step limit\" not in json.load(open(sys.argv[1]))[0][\"warning\"])" "$work/out"'

# Pipes: a reader that has seen enough is no error of ours, but the status tells that not all was read
unread() { # unread WORDS...: stdout is a pipe whose reader has gone
    { sleep 0.1; timeout 120 "$program" "$@" 2>"$work/err"; echo $? >"$work/status"; } | true
    status=$(cat "$work/status")
}
silent() { [ $status -eq 141 ] && [ ! -s "$work/err" ]; }
for writer in "--version" "list" "run --help" "describe pendulum" "modes double_pendulum --json" "errata" "check pendulum"; do
    unread $writer
    check "$writer | true: status 141, in silence" silent
done
for i in 0 1 2; do
    unread ${writers[i]} --output "$work/unread$i"
    check "${writers[i]} | true: status 141, in silence, every file written" eval 'silent && diff -r "$work/deep/$i/b/c" "$work/unread$i"'
done
unread run pendulum --set scene%expect_error=1e-30 --output "$work/unread"
check "a tolerance is missed | true: said, status 1" eval '[ $status -eq 1 ] && one_line'
if command -v gnuplot >/dev/null; then
    unread run pendulum --plot --output "$work/unread"
    check "run --plot | true: status 141, in silence, the picture is drawn" eval 'silent && [ -s "$work/unread/pendulum.png" ]'
fi

summary
