#!/usr/bin/env bash
# What the program prints and the files it writes, whole: each as it is kept in .ci/pages, but for rounding.
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
full=$(realpath "$program")
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
pages=.ci/pages
failures=0
count=0

plain() { # without what rounding decides
    sed -E -e 's/(^|[^0-9A-Za-z_.])-?[0-9.]+[Ee]-(0?0[89]|[1-9][0-9]|0[1-9][0-9]|[1-3][0-9]{2})\b/\1~0/g' \
        -e 's/(^| )(~0|0) +/\1~0 /g; s/ +(~0|0)( |$)/ ~0\2/g' -e 's/n eps\) = [0-9.E+-]+$/n eps) = ~/'
}

keep() { # keep WORDS...: the page of these words is what comes in
    local name=$*
    name=${name//[^A-Za-z0-9_.-]/_}
    count=$((count + 1))
    cat >"$work/$name.txt"
    if [ -n "$accept" ]; then
        cp "$work/$name.txt" "$pages/$name.txt"
    elif ! diff -u "$pages/$name.txt" "$work/$name.txt" >"$work/diff"; then
        echo "FAILED  lagrangia $*: another page; if that is meant: .ci/try_pages.sh --accept"
        head -n 12 "$work/diff"
        failures=$((failures + 1))
    fi
}

page() { # page FILTER WORDS...: what the program prints for WORDS, through the filter
    keep "${@:2}" < <(timeout 600 "$program" "${@:2}" </dev/null 2>&1 | grep -v "^lagrangia: .* takes about " | "$1")
}

costless() { # without what a run costs, which folder it wrote to, and digits that rounding decides
    grep -v -e "^lagrangia: .* takes about " -e "^lagrangia: this build is not optimised" |
        sed -E -e "s,$work/,,g" -e 's/^([#!] lagrangia) [0-9]+\.[0-9]+\.[0-9]+:/\1:/' -e 's/[0-9]+ steps?, [0-9]+ evaluations (.*, )[0-9.]+ s$/~ steps, ~ evaluations \1~ s/' \
            -e 's/"(seconds|threads|steps|evaluations)": [0-9.E+-]+/"\1": ~/g' -e 's/(  [0-9]+ +[0-9]+ .*[^ ]) +[0-9.]+$/\1 ~/' \
            -e 's/ in [0-9.Ee+-]+ s by [0-9]+ process(es)?/ in ~/' -e 's/^(  [^ ]+ +[0-9]+ +[0-9]+) +[0-9.e-]+$/\1 ~/' -e 's/([0-9]\.[0-9]{3})[0-9]{6,}(E[+-][0-9]+)/\1\2/g' \
            -e 's/([0-9]\.[0-9]{9})[0-9]+/\1/g' | plain
}

files() { # files WORDS...: what the program prints for WORDS, and every file that it writes
    rm -rf "$work/files"
    keep files of "$@" < <({
        timeout 600 "$program" "$@" --output "$work/files" </dev/null 2>&1
        python3 .ci/written_files.py "$work/files"
    } | costless)
}

written() { # written NAMES WORDS...: of the files that are written those alone whose names fit
    rm -rf "$work/files"
    "$program" "${@:2}" --output "$work/files" </dev/null >/dev/null 2>&1
    find "$work/files" -type f ! -name "$1" -delete
    keep written by "${@:2}" < <(python3 .ci/written_files.py "$work/files" | costless)
}

claims() { # of check: claim, bound over noise, states, verdict; not how large rounding is, but of methods
    awk '$1 == "methods" { orders = 1 }
        substr($0, 1, 2) == "  " && $NF ~ /^(holds|FAILS)$/ && orders {
        printf "%s noise %s bound %s, %d states, %s\n", substr($0, 1, 42), $(NF - 3), $(NF - 2), $(NF - 1), $NF; next }
        substr($0, 1, 2) == "  " && $NF ~ /^(holds|FAILS)$/ {
        printf "%s bound/noise %.0f, %d states, %s\n", substr($0, 1, 42), $(NF - 2)/$(NF - 3), $(NF - 1), $NF; next }
        { print }' | sed -E -e 's/(measured|,) [0-9.]+ on/\1 ~ on/g' -e 's/([0-9]\.[0-9]{6})[0-9]{6,}/\1/g' | plain
}

statements() { # of principle: the bounds stay, as 1.0(-13), but no Lyapunov exponent
    sed -E -e 's/E([+-][0-9]+) +(holds|differs)$/(\1) \2/' -e 's/^(worst of 13: )[a-z_]+ +/\1 /' \
        -e 's/^(double pendulum: above 10 sigma, and 0.023|is it 0, as without chaos\?|.*: 0, it has [a-zA-Z_]+) .*(holds|differs)$/\1 ~ \2/' | plain
}

ledger() { # of JSON: all but the numbers measured
    sed -E 's/"(value|remark)": ("[^"]*"|[^,]*), //; s/, "remark": "[^"]*"//'
}

measured() { # of stress: statements and bounds, but no number measured, nor those of a remark
    sed -E -e '/^build: /d' -e 's/ +[0-9.]+(e-?[0-9]+)? +((<=|>=|=|[0-9.]+ \.\.) |- +stated)/  ~  \2/' |
        awk 'match($0, / (holds|FAILS|stated)( |$)/) {
            remark = substr($0, RSTART + RLENGTH); gsub(/[0-9]+(\.[0-9]+)?(e-?[0-9]+)?/, "~", remark)
            if (remark ~ /rounding/) sub(/[a-zN ]+: ~/, "   ~", remark)
            print substr($0, 1, RSTART + RLENGTH - 1) remark; next }
            { print }'
}

shapes() { # of JSON: whole numbers and words, but no number measured
    sed -E 's/-?[0-9]\.[0-9]+E[+-][0-9]+/~/g'
}

refused() { # the answer to each line of .ci/refused_words.txt, and its exit status
    local line words
    while IFS= read -r line; do
        eval "words=($line)"
        echo "lagrangia $line"
        "$program" "${words[@]}" </dev/null 2>&1 | sed -e '/^build: /d' -e '/^processor: /d' -e 's/^/    /'
        echo "    status ${PIPESTATUS[0]}"
    done <.ci/refused_words.txt
}

accepted() { # the answer to each line of .ci/accepted_words.txt, its exit status and the names of its files
    local line words folder
    while IFS= read -r line; do
        eval "words=($line)"
        echo "lagrangia $line"
        rm -rf "$work/files"
        folder=(--output "$work/files")
        [[ $line =~ ^(run|sweep|compare)\  ]] || folder=()
        timeout 60 "$program" "${words[@]}" ${folder[@]+"${folder[@]}"} </dev/null 2>&1 |
            sed -E -e '/^LAPACK: /d' -e '/^build: /d' -e '/^method +of the steps/,/^ +a hyphen/d' -e 's/closed form, [0-9.e-]+ s$/closed form/'
        echo "exit status=${PIPESTATUS[0]}"
        [ ! -d "$work/files" ] || (cd "$work/files" && printf 'written: %s\n' *)
    done <.ci/accepted_words.txt
}

own() { # derivation, modes and description of each line of .ci/own_systems.txt, `q = ... ;; &lagrangian ;; parameters`
    local line
    while IFS= read -r line; do
        printf "&scene system = 'own', dt = 0.01, duration = 1.0, %s /\n" "${line%% ;; *}" >"$work/own.nml"
        printf '&%s %s /\n' lagrangian "$(sed 's/^.* ;; \(.*\) ;; .*$/\1/' <<<"$line")" own "${line##* ;; }" >>"$work/own.nml"
        echo "$line"
        for words in derive modes describe "derive --latex"; do (cd "$work" && "$full" $words own.nml 2>&1) | sed -e "/^LAPACK: /d" -e "s/^/    /"; done
    done <.ci/own_systems.txt | sed -E 's/([0-9]\.[0-9]{9})[0-9]+/\1/g' | plain
}

systems=$("$program" list systems | awk '{ print $1 }')
for system in $systems atwood_lift double_pendulum_formulas; do page plain describe "$system"; done
for system in $systems; do page plain modes "$system"; done
page plain modes .ci/inputs/stiff_pair.nml
page plain modes .ci/inputs/stiff_pair.nml --set stiff_pair%k_c=1e16
for principle in $("$program" principle | awk '{ print $1 }'); do page statements principle "$principle"; done
page plain course
page plain principle
page plain principle --json
for slip in "" $("$program" errata | grep -oE "\bE[0-9]+\b" | sort -u); do page plain errata $slip; done
for system in pendulum cart_pendulum rotating_hoop; do page shapes derive "$system" --json; done
page shapes derive cart_pendulum --slip E1 --json
for words in "modes double_pendulum" "principle constraints" "check rolling_disk" "errata E9" "grade data/homework/wedge.txt"; do
    page shapes $words --json
done
page plain list systems
page plain list methods
page claims check
page ledger stress step_limits massless zeno edges_of_numbers wedge_angles reversal symplectic --json
if "$program" --version | grep -q ', optimised'; then
    page shapes bench steps growth modes output samples --quick --json
fi
# Words alone
page plain list
for list in scenes sweeps; do page plain list $list; done
page plain help
for command in $("$program" completion bash | sed -n "s/^        '') words='\(.*\) --set.*/\1/p"); do page plain help "$command"; done
for system in $systems spring_pendulum sphere dry_friction pendulum_in_x_and_y; do page plain derive "$system"; done
for system in cart_pendulum double_pendulum rotating_hoop wedge; do page plain derive "$system" --latex; done
page shapes derive cart_pendulum --numbers
for system in skate pendulum_in_x_and_y; do page plain derive "$system" --fortran; done
{ # whatever a module in Fortran may have
    echo "&scene system = 'cart', dt = 0.1, duration = 1.0, q = 0.1, 0.2 /"
    echo "&lagrangian coordinates = 'x [m] of the cart', 'theta [rad] from straight down',"
    echo "parameters = 'm_c [kg] cart', 'm [kg] bob', 'I [kg m^2] wheel', 'R [m] its radius', 'l [m] rod', 'g [m/s^2]',"
    echo "'b [kg/s] drag', 'e slope', domain = 'm_c > 0', 'm >= 0', 'I >= 0', 'R > 0', 'l > 0', 'b >= 0', 'e < 1.5', 'e >= -0.25',"
    echo "definitions = 'X = x + l sin(theta)', 'h = -l cos(theta)',"
    echo "T = 'm_c/2 x_dot^2 + m/2 (x_dot^2 + l^2 theta_dot^2 + 2 l x_dot theta_dot cos(theta)) + I/2 (x_dot/R)^2',"
    echo "V = 'm g h + m_c g e x', Q_x = '-b x_dot', rotors = 'wheel, I: x/R', positions = 'cart, m_c: x, 0', 'bob, m: X, h',"
    echo "quantities = 'p [kg m/s] momentum = (m_c + m) x_dot + m l theta_dot cos(theta)', equilibrium = '0', '0' /"
    echo "&cart m_c = 1.0, m = 0.5, I = 0.1, R = 0.2, l = 1.0, g = 9.81, b = 0.1, e = 0.0 /"
} >"$work/cart.nml"
keep derive a cart --fortran < <(cd "$work" && "$full" derive cart.nml --fortran 2>&1 | plain)
for sheet in data/homework/*.txt; do page plain grade "$sheet"; done
page plain describe pendulum --set pendulum%b=0.1
for b in 0.3 2 6; do page plain describe oscillator --set oscillator%m=1 --set oscillator%k=1 --set oscillator%b=$b; done
page plain describe oscillator --set oscillator%k=0
page plain describe rotating_wire --set rotating_wire%omega=0
page plain describe rotating_hoop --set rotating_hoop%omega=0
page plain describe driven_pendulum --set driven_pendulum%amplitude=0
page plain describe driven_pendulum --set driven_pendulum%b=0.1
{ # equations that are too long to be printed
    echo "&scene system = 'long', dt = 0.1, duration = 1.0, q = 1.0 /"
    echo "&lagrangian coordinates = 'x [m] place', parameters = 'm [kg] mass', 'k [J] strength', 'b [kg/s] drag',"
    echo "L = 'm/2 x_dot^2 + k ($(printf 'sin(1.%d1 x) + ' {1..40})cos(x))', Q_x = '-b x_dot',"
    echo "quantities = 'sum = $(printf 'sin(1.%d1 x) + ' {1..9})cos(x)' /"
    echo "&long m = 2.0, k = 0.1, b = 0.2 /"
} >"$work/long.nml"
keep describe a long L < <("$program" describe "$work/long.nml" 2>&1 | plain)
page plain manual
for shell in bash zsh; do page plain completion $shell; done
page plain describe scene
page measured stress # a bound that does not hold is another page
keep refused words < <(refused)
keep accepted words < <(accepted | costless)
keep graded lines < <(python3 .ci/graded_sheets.py "$program")
# shellcheck disable=SC2046
keep graded derivations < <(python3 .ci/derived_sheets.py "$program" $(grep -l "&lagrangian" data/scenes/*.nml .ci/inputs/*.nml |
    grep -vE "long_|horizon|crowd|slow_space|nine_damped|kepler_|kick|two_constraints"))
keep own systems < <(own)
page plain describe hanging_chain --set hanging_chain%n=1
page plain describe spring_pendulum
page plain describe sphere
page plain describe symmetric_top
page plain modes oscillator --set oscillator%b=0.3
page plain modes rotating_hoop --set rotating_hoop%r=0.5 --set rotating_hoop%omega=7
page plain modes charged_particle --set charged_particle%trap=3 --set charged_particle%magnetic=0,0,2
page plain modes hanging_chain --set hanging_chain%n=7
page plain modes pendulum --at 3.141592653589793
page plain modes pendulum_in_x_and_y
page claims check methods

# Files
files run bouncing_ball
files run double_pendulum_section charged_trap damped_driven_pendulum
files run cart_pendulum_auto cart_pendulum_small pendulum --json
files run bouncing_ball --format csv
files run rotating_hoop --format npy
files run pendulum oscillator sphere --error-estimate
files run pendulum oscillator --overlay
files run pendulum --set pendulum%l=2 --set scene%method=verlet --set scene%dt=0.3
written '*.html' run cart_pendulum sphere bouncing_ball --animate
files compare pendulum --methods verlet,rk4,dop853
files compare double_pendulum --methods gauss16,rk4 --json
files compare pendulum --starts "1 2 0:7"
for system in pendulum cart_pendulum double_pendulum hanging_chain rotating_hoop; do files modes $system; done
for n in 8 13; do files modes hanging_chain --set hanging_chain%n=$n; done
files modes .ci/inputs/long_rotor.nml
written '*.html' modes hanging_chain --animate
written '*.html' modes charged_particle --set charged_particle%trap=3 --set charged_particle%magnetic=0,0,2 --animate
written '*.html' run atwood_lift oscillator driven_oscillator wedge rolling_disk charged_particle --animate
written '*.html' run rotating_wire rotating_hoop driven_pendulum double_pendulum --animate
keep closed forms that auto takes < <(for scene in atwood wedge oscillator damped_oscillator driven_oscillator rotating_wire charged_particle \
    pendulum pendulum_rotation pendulum_separatrix rolling_disk cart_pendulum driven_pendulum rotating_hoop bouncing_ball; do
    "$program" run $scene --set scene%method=auto --output "$work/files" 2>&1 </dev/null | grep "auto took"
done)
files sweep flip_map --over theta1=0.5:3:6
files sweep flip_map --over theta1=0.5:3:6 --over theta2=-1:1:3 --json
files sweep period_of_amplitude --over theta=0.5:3:6
files sweep resonance --over drive_frequency=0.2:3:5 --format csv
files sweep ueda --over f=5.5:13.5:3
written '*.gp' sweep basins --over theta=-1:1:3 --over theta_dot=-1:1:3
written '*.gp' sweep bifurcation --over f=1:1.5:3
written '*.gp' sweep section --over theta2_dot=-1:1:3
written '*.gp' sweep lyapunov_map --over W=0.5:1:2 --over f=1:1.5:2
written '*.gp' sweep flip_map --over theta1=0.5:3:6:random --over theta2=-1:1:6:random
written '*.gp' modes oscillator --set oscillator%k=1e10
written '*.gp' modes oscillator --set oscillator%k=1e-10
written '*.gp' run pendulum --set "scene%plot='theta+energy_drift'" --set scene%duration=1
written '*.gp' run pendulum pendulum_rotation --overlay --set scene%columns=t,theta,theta_dot,theta_ddot,energy,x_bob,y_bob,tension,L_z --set scene%duration=1
written '*.dat' run pendulum --set scene%method=dop853 --set scene%tolerance=1e-9 --set scene%samples=4 --set scene%duration=2 --set scene%event='t = 1 stop'
written '*.html' run .ci/inputs/named_size.nml .ci/inputs/parameter_size.nml .ci/inputs/defined_size.nml --animate
rest=.ci/inputs/far_rest.nml
files sweep $rest --over x0=-6:6:7 --over x_dot=-1:1:2
written '*.gp' sweep $rest --set scene%duration=25
written '*.gp' sweep $rest --over x0=-6.5:6.5:14 --over x_dot=-1:1:2
written '*.gp' sweep $rest --over x0=-5:-5:1 --over x_dot=-1:1:2
written '*.gp' sweep $rest --over k=4:4:1:log --over x_dot=-1:1:2
written '*.gp' sweep $rest --over k=8:4:3:log --over x_dot=1:-1:3
written '*.gp' sweep $rest --over k=4:8:3:random --over x_dot=1:-1:3
written '*.gp' sweep section --over theta2_dot=1:1:1 --set scene%duration=10
written '*.gp' sweep pendulum --over theta=0.5:3:61:random --set scene%duration=1 --keep theta
written '*.gp' sweep .ci/inputs/root.nml --keep x --set scene%duration=1000 --set sweep%strobe=0.1 --set sweep%points=20000 --over x=1:3:3
files sweep .ci/inputs/root.nml
files sweep flip_map --set scene%duration=3.325 --over theta1=3:3.1:2
files sweep pendulum --over theta=1:2:2 --keep 'first theta_dot = -0.12500000000000000000000000 falling'
written '*.html' run .ci/inputs/bare_tolerance.nml --animate
written '*.html' run .ci/inputs/bare.nml --set scene%q=0 --animate
written '*.html' run cart_pendulum_auto --set scene%duration=2 --animate
written '*.html' run pendulum --set scene%q=0 --set scene%duration=1 --animate
written '*.html' run pendulum --set scene%duration=1e-160 --set scene%dt=1e-162 --animate
written '*.html' compare pendulum --methods rk4,verlet --animate --set scene%dt=0.3 --set scene%duration=9 --set scene%event='theta = -0.99 stop'
written '*.html' modes .ci/inputs/unseen.nml --animate
written '*.html' run .ci/inputs/crowd.nml --animate
written '*.html' modes .ci/inputs/crowd.nml --animate
written '*.html' modes .ci/inputs/_bare.nml --animate
written '*' run .ci/inputs/swing_8.nml .ci/inputs/swing_4.nml --overlay
written '*.gp' run .ci/inputs/swing_4.nml .ci/inputs/swing_8.nml --overlay
written '*.gp' compare pendulum --starts '1:1 1:-1' --set scene%duration=0.5
written '*.gp' sweep .ci/inputs/height.nml --over h0=-5:5:2 --over height_dot=-1:1:2
written '*.gp' run .ci/inputs/two_springs.nml
written '*.gp' run .ci/inputs/sea.nml --set scene%columns=t,x,y_drift_2,energy_drift --set scene%plot=y_drift_2+energy_drift
files run .ci/inputs/kick.nml
page claims check .ci/inputs/force_alone.nml
page claims check .ci/inputs/kick.nml
page claims check .ci/inputs/horizon.nml
written '*.gp' run pendulum --set scene%plot='theta+energy_drift' --set scene%columns=t,theta,energy_drift --set scene%dt=0.05 --set scene%duration=2000 --set scene%every=1
written '*.gp' run double_pendulum --set scene%columns=t,x_bob1,y_bob1,x_bob2,y_bob2 --set scene%plot='x_bob1:y_bob1+y_bob2' --set scene%duration=2
written '*.gp' run pendulum --set scene%q=0 --set scene%columns=t,y_bob,theta --set scene%plot=y_bob:theta --set scene%duration=1
written '*.html' run pendulum --animate --set scene%duration=1 --set scene%title='theta of 5e3x x^foo a_b ^ c 5e'
"$program" bench precision --quick --problems oscillator,P1 --methods rk4,dop853 --output "$work/files" >/dev/null 2>&1
keep the script of bench < <(sed -E 's/\[[0-9.e+-]+:[0-9.e+-]+\]/[~]/g' "$work/files/bench.gp")
command -v gnuplot >/dev/null && files report pendulum_rotation hanging_chain
command -v gnuplot >/dev/null && files report .ci/inputs/bare.nml
for principle in $("$program" principle | awk '{ print $1 }'); do written '*' principle "$principle"; done
if [ -n "$accept" ]; then
    echo "$count pages kept in $pages"
else
    echo "$count pages, $failures of them differ"
fi
[ "$failures" -eq 0 ]
