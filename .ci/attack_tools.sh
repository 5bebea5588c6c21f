# For attack.sh and attack_signals.sh, which source this: where they work, what they claim.
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2
program=${1:-}
for found in $(ls -t build/gfortran_*/app/lagrangia 2>/dev/null); do # bench wants an optimised one
    [ -z "$program" ] && "$found" --version | grep -q ', optimised' && program=$found
done
[ -x "$program" ] || { echo "no program: fpm build --profile release"; exit 2; }
program=$(realpath "$program")
work=$(mktemp -d) || exit 2
mkdir "$work/data" # so that shipped scenes have their names there too
ln -s "$PWD/data/scenes" "$PWD/data/reference" "$work/data"
disk=""
finish() {
    [ -z "$disk" ] || umount "$disk"
    rm -rf "$work"
}
trap finish EXIT
count=0
failures=0
status=0
: >"$work/err"

check() { # check CLAIM COMMAND...: the claim holds if the command succeeds
    count=$((count + 1))
    if ("${@:2}") >/dev/null 2>&1; then
        printf 'ok      %s\n' "$1"
    else
        printf 'FAILED  %s\n' "$1"
        printf '        | %s\n' "status $status" "stderr: $(head -c 400 "$work/err")"
        failures=$((failures + 1))
    fi
}

run() { # run WORDS...: status, $work/out, $work/err
    timeout 120 "$program" "$@" >"$work/out" 2>"$work/err" </dev/null
    status=$?
}

one_line() { # ours, short, and no backtrace
    [ "$(wc -l <"$work/err")" -eq 1 ] && grep -q '^lagrangia: ' "$work/err" &&
        [ "$(wc -c <"$work/err")" -le 301 ] && ! grep -qi 'backtrace\|#0 ' "$work/err"
}

only_ours() { # one line or, after a warning, more: all ours
    [ -s "$work/err" ] && ! grep -qv '^lagrangia: ' "$work/err"
}

leftovers() { # no temporary in the folder
    [ -z "$(find "$1" -name '.lagrangia-*')" ]
}

plant() { # plant FOLDER FILES...: old content under each name
    local file
    for file in "${@:2}"; do printf 'old %s\n' "$file" >"$1/$file"; done
}

unharmed() { # unharmed FOLDER FILES...: bit for bit
    local file
    for file in "${@:2}"; do [ "$(cat "$1/$file")" = "old $file" ] || return 1; done
}

summary() { # the last line, and the exit status
    echo "$count claims, $failures failed"
    exit $((failures > 0))
}
