#!/usr/bin/env bash
# What CONTRIBUTING.md, README.md and docs/reliability.md say of the house is so: the rooms and
# their order are those of check_layers.sh and of src; files, folders, suites and tests are there.
set -u
cd "$(dirname "$0")/.." || exit 2
bad=0
complain() { echo "$*"; bad=1; }

order=$(sed -n '/rooms = split("/,/order, " ")/p' .ci/check_layers.sh | grep -o '"[a-z ]*"' | tr -d '"\n' |
    sed 's/middle/references, integrators/' | sed 's/ *$//; s/ \+/ /g; s/references, integrators/references,integrators/; s/ / < /g; s/,/, /')
tr '\n' ' ' <CONTRIBUTING.md | tr -s ' ' | grep -qF "$order" || complain "the order of the rooms is not '$order'"
for text in README.md CONTRIBUTING.md; do
    while read -r path; do
        compgen -G "$path" >/dev/null || compgen -G "src/$path" >/dev/null || compgen -G "src/*/$path" >/dev/null ||
            complain "$text: there is no $path"
    done < <(grep -o '`[^` ]*`' "$text" | tr -d '`' | grep -v '^data/output/' | grep -E '^[A-Za-z_./*]+(/[A-Za-z_.]+|\.(f90|md|sh|py))$' |
        sed 's/NAME_reference/pendulum_reference/; s/NAME/pendulum/; s,src/commands/pendulum,src/commands/bench,; s,src/integrators/pendulum,src/integrators/rk4,' | sort -u)
done
[ "$(grep -oE '^\| `[a-z`, ]+ \|' CONTRIBUTING.md | grep -o '[a-z]*' | sort)" = "$(find src -mindepth 1 -maxdepth 1 -type d -printf '%f\n' | sort)" ] ||
    complain "CONTRIBUTING.md: the table of rooms is not what src has"
for suite in $(grep -oE 'suites? (`[a-z_]+`(, | and )?)+' CONTRIBUTING.md | grep -o '`[a-z_]*`' | tr -d '`'); do
    grep -q "TestSuite(\"$suite\")" test/*.f90 || complain "CONTRIBUTING.md: there is no suite $suite"
done
while IFS= read -r row; do # `suite`: test, test
    suite=$(sed 's/`\([^`]*\)`.*/\1/' <<<"$row")
    [[ $suite == lagrangia* ]] && continue
    grep -q "TestSuite(\"$suite\")" test/*.f90 || complain "docs/reliability.md: there is no suite $suite"
    for name in $(sed -n 's/^`[^`]*`: //p' <<<"$row" | tr ',' ' '); do
        grep -q "TestMethod(\"$name" test/*.f90 || complain "docs/reliability.md: there is no test $suite: $name"
    done
done < <(awk -F'|' 'NF >= 4 { print $3 }' docs/reliability.md | grep -oE '`[a-z_ ]+`(: [a-z_, ]+)?')
scenes=$(find data/scenes -name '*.nml' | wc -l)
grep -q "of the $scenes rows" README.md || complain "README.md: the main job prints $scenes rows"
compiled=$(find src app -name '*.f90' -o -name '*.c' | wc -l)
grep -q "more than ${compiled::-2}00 files are compiled" README.md || complain "README.md: $compiled files are compiled"
grep -n "^\$ .*\bcut -c" docs/*.md && complain "a number that is cut may lose its exponent"
[ "$(wc -l <README.md)" -lt 200 ] || complain "README.md has 200 lines or more"
[ "$(wc -l <CONTRIBUTING.md)" -lt 250 ] || complain "CONTRIBUTING.md is too long for an evening"
exit $bad
