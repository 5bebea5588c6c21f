#!/usr/bin/env bash
# The runner of the tests must be believed: what it says of tests that fail (.ci/failing) or crash
# (.ci/crashing), the status it ends with, its options; and what every suite must have.
set -u
cd "$(dirname "$0")/.." || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
failures=0

check() { # check CLAIM COMMAND...: the claim holds if the command succeeds
    if ("${@:2}") >/dev/null 2>&1; then
        printf 'ok      %s\n' "$1"
    else
        printf 'FAILED  %s\n' "$1"
        sed 's/^/        | /' "$work/out" | head -n 40
        failures=$((failures + 1))
    fi
}

run() { # run PROJECT WORDS...: its tests; their status, and all they say in $work/out
    local program
    program=$(ls -t ".ci/$1"/build/gfortran_*/test/"$1-test" 2>/dev/null | head -n 1)
    { # the shell itself would report the crash
        timeout 60 "$program" "${@:2}" >"$work/out" 2>&1 </dev/null
        status=$?
    } 2>/dev/null
}

says() { # says TEXT...: each is a line, or part of one
    local text
    for text; do
        grep -qF -- "$text" "$work/out" || return 1
    done
}

line_of() { # line_of TEXT: its line in the failing tests
    grep -nF -- "$1" .ci/failing/test/main.f90 | cut -d: -f1
}

for project in failing crashing; do
    fpm build -C ".ci/$project" --tests >"$work/out" 2>&1 || { cat "$work/out"; exit 1; }
done

run failing
check "failing tests end with status 2" [ $status -eq 2 ]
check "and are counted" says "Tests run: 83, Failures: 5, Errors: 0" "Failed:"
check "a failure names test, file and line" says "Failure in: failing.fails_once" \
    "[test/main.f90:$(line_of '[1, 3]')]" "[test/main.f90:$(line_of 'assertGreaterThan(1.0')]" "    failing.fails_and_returns"
check "and stands before the tests that come after it" \
    eval '[ "$(grep -n "the first failure" "$work/out" | cut -d: -f1)" -lt "$(grep -n "inner.fails_once" "$work/out" | head -n 1 | cut -d: -f1)" ]'
run failing --filter inner
check "--filter runs what has the text in its name" says "Tests run: 2, Failures: 1, Errors: 0"
run failing -f passes
check "tests that pass end with status 0" eval '[ $status -eq 0 ] && says " OK" " (78 tests)"'
run failing --filter nothing
check "a filter that fits no test is an error" eval '[ $status -eq 2 ] && says "no test has '"'nothing'"' in its name"'
run failing --filter
check "a filter needs a text" eval '[ $status -eq 2 ] && says "needs a text"'
run failing --fliter inner
check "an unknown option is refused" eval '[ $status -eq 2 ] && says "unknown option '"'--fliter'"'"'
run failing -v --filter inner
check "-v names each test as it starts and ends" says "Start: <inner.fails_once>" "  end: <inner.fails_once>" "Start: <inner.passes>"
for how in "is_killed:before the kill:killed by signal 11" "stops:before the stop:the program was stopped" \
    "breaks_a_bound:before the bound:the program was stopped"; do
    IFS=: read -r name words end <<<"$how"
    run crashing --filter "$name"
    check "a crash loses nothing: $name" eval '[ $status -ne 0 ] && says "Error in crashing.$name: $end" "$words"'
done

# A test's random numbers are its own: each test of a suite that draws begins the sequence again
python3 - test/test_*.f90 >"$work/out" <<'END'
# each test that draws, itself or by a procedure of its file, has the set-up or calls it
import re, sys
draws = re.compile(r"\b(uniform|draw_parameters|draw_state|check_reference|check_state|check_system)\(")
for path in sys.argv[1:]:
    text = open(path).read()
    if not re.search(r"^ *use (random_states|reference_checks|system_checks)\b", text, re.M): continue
    body = dict(re.findall(r"^    (?:pure |elemental |recursive )*(?:subroutine|function) (\w+)(.*?)^    end (?:subroutine|function)", text, re.M | re.S))
    def drawing(name, seen):
        if name in seen: return False
        words = set(re.findall(r"\w+", body[name])) & set(body)
        return bool(draws.search(body[name])) or any(drawing(w, seen | {name}) for w in words)
    for test, rest in re.findall(r'TestMethod\("[^"]*",[\s&]*(\w+)(.*?)\)\)', text, re.S):
        if test in body and drawing(test, set()) and "restart_random" not in rest + body[test]:
            print(f"{path}: {test} draws, and has no setUp=restart_random")
END
check "each test begins its random numbers" [ ! -s "$work/out" ]
python3 - test/*.f90 >"$work/out" <<'END'
# each assertTrue and assertFalse with one argument: nothing but the condition
import re, sys
for path in sys.argv[1:]:
    text = re.sub(r"&\s*\n\s*", "", open(path).read()) if "test_harness" not in path else ""
    for call in re.finditer(r"call assert(?:True|False)\(", text):
        depth, quote, commas, at = 1, None, 0, call.end()
        while depth:
            c, at = text[at], at + 1
            if quote: quote = None if c == quote else quote
            elif c in "'\"": quote = c
            elif c in "([": depth += 1
            elif c in ")]": depth -= 1
            elif c == "," and depth == 1: commas += 1
        if not commas: print(path + ": " + text[call.start():at])
END
check "each assertTrue and assertFalse has a message" [ ! -s "$work/out" ]
grep -nE 'random_number|random_seed' test/*.f90 >"$work/out"
check "no test draws from elsewhere" [ ! -s "$work/out" ]

echo "$failures failed"
exit $((failures > 0))
