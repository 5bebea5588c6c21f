#!/usr/bin/env bash
# What the program prints, whole pages: each as it is kept in .ci/pages, but for rounding.
#
#     .ci/try_pages.sh [PROGRAM]            compare; status 1 where a page differs
#     .ci/try_pages.sh [PROGRAM] --accept   after a change that is meant: keep them, and read git diff
#
# Numbers below 1e-7 are shown as ~0 but where they are bounds, the others as they are printed.
set -u
cd "$(dirname "$0")/.." || exit 2
accept=
[ "${*: -1}" = --accept ] && accept=yes && set -- "${@:1:$#-1}"
program=${1:-$(ls -t build/gfortran_*/app/lagrangia 2>/dev/null | head -n 1)}
[ -x "$program" ] || { echo "no program: fpm build --profile release"; exit 2; }
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
pages=.ci/pages
failures=0
count=0

plain() { # without what rounding decides
    sed -E -e 's/(^|[^0-9A-Za-z_.])-?[0-9.]+[Ee]-(0?0[89]|[1-9][0-9]|0[1-9][0-9]|[1-3][0-9]{2})\b/\1~0/g' \
        -e 's/(^| )(~0|0) +/\1~0 /g; s/ +(~0|0)( |$)/ ~0\2/g' -e 's/n eps\) = [0-9.E+-]+$/n eps) = ~/'
}

page() { # page FILTER WORDS...: what the program prints for WORDS, through the filter
    local name=${*:2}
    name=${name//[^A-Za-z0-9_.-]/_}
    count=$((count + 1))
    timeout 600 "$program" "${@:2}" </dev/null 2>&1 | grep -v "^lagrangia: .* takes about " | "$1" >"$work/$name.txt"
    if [ -n "$accept" ]; then
        cp "$work/$name.txt" "$pages/$name.txt"
    elif ! diff -u "$pages/$name.txt" "$work/$name.txt" >"$work/diff"; then
        echo "FAILED  lagrangia ${*:2}: another page; if that is meant: .ci/try_pages.sh --accept"
        head -n 12 "$work/diff"
        failures=$((failures + 1))
    fi
}

claims() { # of check: claim, bound over noise, states, verdict; not how large rounding is
    awk 'substr($0, 1, 2) == "  " && $NF ~ /^(holds|FAILS)$/ {
        printf "%s bound/noise %.0f, %d states, %s\n", substr($0, 1, 42), $(NF - 2)/$(NF - 3), $(NF - 1), $NF; next }
        { print }' | sed -E -e 's/(measured|,) [0-9.]+ on/\1 ~ on/g' -e 's/([0-9]\.[0-9]{6})[0-9]{6,}/\1/g' | plain
}

statements() { # of principle: the bounds stay, as 1.0(-13)
    sed -E -e 's/E([+-][0-9]+) +(holds|fails)$/(\1) \2/' -e 's/^(worst of 13: )[a-z_]+ +/\1 /' | plain
}

ledger() { # of JSON: all but the numbers measured
    sed -E 's/"(value|remark)": ("[^"]*"|[^,]*), //; s/, "remark": "[^"]*"//'
}

shapes() { # of JSON: whole numbers and words, but no number measured
    sed -E 's/-?[0-9]\.[0-9]+E[+-][0-9]+/~/g'
}

systems=$("$program" list systems | awk '{ print $1 }')
for system in $systems atwood_lift double_pendulum_formulas; do page plain describe "$system"; done
for system in $systems; do page plain modes "$system"; done
for principle in action constraints gauge least-time virtual-work; do page statements principle "$principle"; done
for slip in "" $("$program" errata | grep -oE "\bE[0-9]+\b" | sort -u); do page plain errata $slip; done
for system in pendulum cart_pendulum rotating_hoop; do page shapes derive "$system" --json; done
page shapes derive cart_pendulum --slip E1 --json
for words in "modes double_pendulum" "principle constraints" "check rolling_disk" "errata E9" "grade data/homework/wedge.txt"; do
    page shapes $words --json
done
page plain list systems
page plain list methods
page claims check
page ledger stress --json
if "$program" --version | grep -q ', optimised'; then
    page shapes bench steps growth modes output samples --quick --json
fi
if [ -n "$accept" ]; then
    echo "$count pages kept in $pages"
else
    echo "$count pages, $failures of them differ"
fi
[ "$failures" -eq 0 ]
