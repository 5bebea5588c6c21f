#!/usr/bin/env bash
# Make this machine ready to build and run lagrangia; what is already there is left alone.
#
#   ./setup.sh                  compiler, LAPACK, BLAS, GSL, gnuplot and fpm
#   ./setup.sh --dev            the same, and what .ci/run needs: two tools for lint, FORD for
#                               the API pages, valgrind, the reference BLAS and LAPACK, zsh, mandoc,
#                               Chromium, pandas and matplotlib
#   ./setup.sh --cluster        the first, and OpenCoarrays with Open MPI, for sweeps on many images
#   ./setup.sh install [DIR]    the same as the first, and then lagrangia itself below DIR (default
#                               ~/.local): bin, lib, include, completion for bash and zsh, manual
#
# Debian and its relatives: missing libraries come from apt-get (as root, or through sudo), fpm and
# the lint tools from pip into a virtual environment of their own. Elsewhere it says what to install.
# Exit status: 0 ready, 1 not ready (the last lines say why), 2 usage.
set -u

fpm_wheel="fpm==0.12.0"
lint_wheels=("fortitude-lint==0.10.0" "findent==4.3.6")
ford_wheel="ford==7.0.13"
pip_settings='^(https?|no|all|ftp)_proxy=|^(HTTPS?|NO|ALL|FTP)_PROXY=|^PIP_|^SSL_CERT_|^REQUESTS_CA_'
missing_packages=()
missing_tools=()
ready=true
asked=false # the administrator: whatever else is missing can wait
dev=false
cluster=false

say() { printf 'setup: %s\n' "$*"; }
complain() { printf 'setup: %s\n' "$*" >&2; ready=false; }
has() { command -v "$1" >/dev/null 2>&1; }

usage() { sed -n '2,14s/^# \{0,1\}//p' "$0"; }

at_least() { # at_least WANTED VERSION
    [ -n "$2" ] && [ "$(printf '%s\n%s\n' "$1" "$2" | sort -V | head -n 1)" = "$1" ]
}

# --- what is there -------------------------------------------------------------------------------

compiler_version() { "${FPM_FC:-gfortran}" -dumpfullversion 2>/dev/null; }

fpm_version() { # another program is called fpm too: only Fortran's prints this line
    "${1:-fpm}" --version 2>/dev/null | sed -n 's/^Version: *\([0-9.]*\).*/\1/p'
}

tool_version() { "$1" --version 2>/dev/null | sed -n '1s/[^0-9]*\([0-9.]*\).*/\1/p'; }

tool_is_fine() {
    case $1 in
        fpm) at_least 0.12.0 "$(fpm_version)" ;;
        fortitude) at_least 0.10.0 "$(tool_version fortitude)" ;;
        findent) has findent ;;
        ford) at_least 7.0.13 "$(tool_version ford)" ;;
    esac
}

compiler_is_fine() { at_least 12 "$(compiler_version)"; }

links() { # links LIBRARY...: does a program that needs these libraries build and start?
    local library keep=()
    if ! compiler_is_fine; then # nothing to try it with: look for the files
        for library; do
            compgen -G "/usr/lib/*/lib$library.so" >/dev/null || return 1
        done
        return 0
    fi
    [ "$(uname)" = Linux ] && keep=(-Wl,--no-as-needed)
    # shellcheck disable=SC2086  # the user's flags are several words
    "${FPM_FC:-gfortran}" "$trial/trial.f90" -o "$trial/trial" ${FPM_LDFLAGS:-} \
        ${keep[@]+"${keep[@]}"} "${@/#/-l}" >/dev/null 2>&1 && "$trial/trial"
}

find_missing() {
    missing_packages=()
    missing_tools=()
    missing_libraries=()
    compiler_is_fine || missing_packages+=(gfortran)
    if ! links lapack blas gsl gslcblas; then
        links lapack blas || missing_libraries+=("LAPACK and BLAS")
        links gsl gslcblas || missing_libraries+=("GSL")
    fi
    local library
    for library in ${missing_libraries[@]+"${missing_libraries[@]}"}; do
        case $library in
            # the pthread flavour: Debian's serial one gives wrong numbers when two threads call it
            LAPACK*) missing_packages+=(libopenblas-pthread-dev) ;;
            GSL) missing_packages+=(libgsl-dev) ;;
        esac
    done
    has gnuplot || missing_packages+=(gnuplot-nox)
    tool_is_fine fpm || missing_tools+=(fpm)
    if $dev; then
        tool_is_fine fortitude || missing_tools+=(fortitude)
        tool_is_fine findent || missing_tools+=(findent)
        tool_is_fine ford || missing_tools+=(ford)
        has valgrind || missing_packages+=(valgrind)
        has chromium || has chromium-browser || has google-chrome || missing_packages+=(chromium)
        /usr/bin/python3 -c 'import matplotlib, numpy, pandas' 2>/dev/null || missing_packages+=(python3-pandas python3-matplotlib)
        has zsh || missing_packages+=(zsh)
        has groff || missing_packages+=(groff-base)
        has mandoc || missing_packages+=(mandoc)
        compgen -G '/usr/lib/*/blas/libblas.so.3' >/dev/null || missing_packages+=(libblas3)
        compgen -G '/usr/lib/*/lapack/liblapack.so.3' >/dev/null || missing_packages+=(liblapack3)
    fi
    if $cluster && ! { has caf && has cafrun; }; then
        missing_packages+=(libcoarrays-openmpi-dev libopenmpi-dev openmpi-bin)
    fi
    if [ ${#missing_tools[@]} -gt 0 ] && [ -z "$(find_python)" ]; then
        missing_packages+=(python3-venv)
    fi
}

nothing_missing() { [ ${#missing_packages[@]} -eq 0 ] && [ ${#missing_tools[@]} -eq 0 ]; }

find_python() { # a python3 that can make virtual environments; the system's own first
    local python
    for python in /usr/bin/python3 python3; do
        if "$python" -c 'import ensurepip, venv' >/dev/null 2>&1; then
            echo "$python"
            return
        fi
    done
}

# --- installing ----------------------------------------------------------------------------------

find_privilege() { # privilege: root, sudo or none
    privilege=none
    if [ "$(id -u)" -eq 0 ]; then
        privilege=root
    elif has sudo; then
        if sudo -n true 2>/dev/null; then
            privilege=sudo
        elif [ -t 0 ]; then
            say "sudo may ask for your password"
            sudo true && privilege=sudo
        fi
    fi
}

as_root() { # sudo forgets the environment: hand over what the downloads need
    if [ "$privilege" = root ]; then
        "$@"
        return
    fi
    local settings
    mapfile -t settings < <(env | grep -E "$pip_settings")
    sudo -H env ${settings[@]+"${settings[@]}"} "$@"
}

install_packages() {
    has apt-get || return 0
    if [ "$privilege" = none ]; then
        if [ "${missing_packages[*]}" != gnuplot-nox ]; then
            asked=true
            complain "you are not root and cannot use sudo: ask the administrator for" \
                "'apt-get install --no-install-recommends ${missing_packages[*]}', then run this again"
        fi
        return
    fi
    say "missing: ${missing_packages[*]}"
    local options=(-qq -o DPkg::Lock::Timeout=300) install=(install --yes --no-install-recommends)
    takes "apt-get update: fetching the lists of packages" as_root apt-get "${options[@]}" update ||
        say "apt-get update failed; trying with the package lists at hand"
    takes "apt-get install: $(apt_size)" as_root env DEBIAN_FRONTEND=noninteractive apt-get \
        "${options[@]}" -o Dpkg::Use-Pty=0 "${install[@]}" "${missing_packages[@]}" || {
        tail -n 15 "$trial/step.log" >&2
        complain "apt-get could not install ${missing_packages[*]}"
    }
}

apt_size() { # how many packages that is, and how much is fetched
    LC_ALL=C apt-get install --simulate -o Debug::NoLocking=1 -o APT::Get::Show-User-Simulation-Note=0 \
        --no-install-recommends "${missing_packages[@]}" 2>/dev/null | grep -c '^Inst ' | sed 's/$/ packages with what they need/'
}

takes() { # takes WHAT COMMAND...: say what is done, every 15 s that it goes on, and how long it took
    local what=$1 start=$SECONDS job status
    shift
    say "$what ..."
    "$@" </dev/null >"$trial/step.log" 2>&1 &
    job=$!
    while kill -0 $job 2>/dev/null; do
        sleep 0.5
        if [ $((SECONDS - start)) -ge 15 ] && [ $(((SECONDS - start)%15)) -eq 0 ]; then
            say "... still at it after $((SECONDS - start)) s"
            sleep 1
        fi
    done
    wait $job
    status=$?
    [ $status -ne 0 ] || say "... done, $((SECONDS - start)) s"
    return $status
}

link_tool() { # link_tool NAME: put the tool where shells look, but never over somebody else's file
    local link=$link_directory/$1
    if [ -e "$link" ] && [ "$(readlink "$link")" != "$tools/bin/$1" ]; then
        complain "$link is there already and too old, or another program: remove it, or put" \
            "$tools/bin first on your PATH"
        return
    fi
    "${as_owner[@]}" mkdir -p "$link_directory" &&
        "${as_owner[@]}" ln -sfn "$tools/bin/$1" "$link"
}

pip_install() {
    "${as_owner[@]}" "$tools/bin/python3" -m pip install --quiet --disable-pip-version-check \
        --retries 2 "$@" </dev/null >>"$trial/pip.log" 2>&1
}

install_wheels() { # install_wheels WHEEL...: into the virtual environment, which is made if need be
    say "installing with pip into $tools: $* ..."
    if ! "$tools/bin/python3" -m pip --version >/dev/null 2>&1; then
        "${as_owner[@]}" "$python" -m venv --clear "$tools" || {
            complain "$python could not make a virtual environment in $tools"
            return 1
        }
    fi
    # pip brings its own certificates; behind a proxy the system's may be the right ones
    pip_install "$@" || pip_install --cert /etc/ssl/certs/ca-certificates.crt "$@" || {
        tail -n 4 "$trial/pip.log" >&2
        if grep -q CERTIFICATE_VERIFY_FAILED "$trial/pip.log"; then
            complain "pip could not install $*: this machine does not know the certificate of the" \
                "package index, or of a proxy; put that into /usr/local/share/ca-certificates and" \
                "run update-ca-certificates"
        else
            complain "pip could not install $*: no network, or no wheel for this machine?"
        fi
        return 1
    }
}

install_tools() {
    local python wheels=() tool
    python=$(find_python)
    if [ -z "$python" ]; then
        complain "${missing_tools[*]}: pip needs a python3 with venv, and there is none"
        return
    fi
    if [ "$privilege" = none ]; then
        tools=${XDG_DATA_HOME:-$HOME/.local/share}/lagrangia/venv
        link_directory=$HOME/.local/bin
        as_owner=(env)
    else
        tools=/opt/lagrangia-tools
        link_directory=/usr/local/bin
        as_owner=(as_root)
    fi
    for tool in "${missing_tools[@]}"; do
        [ -x "$tools/bin/$tool" ] && PATH=$tools/bin:$PATH tool_is_fine "$tool" && continue
        case $tool in
            fpm) wheels+=("$fpm_wheel") ;;
            fortitude) wheels+=("${lint_wheels[0]}") ;;
            findent) wheels+=("${lint_wheels[1]}") ;;
            ford) wheels+=("$ford_wheel") ;;
        esac
    done
    if [ ${#wheels[@]} -gt 0 ]; then
        install_wheels "${wheels[@]}" || return
    fi
    for tool in "${missing_tools[@]}"; do
        link_tool "$tool"
    done
    hash -r
}

# --- the verdict ---------------------------------------------------------------------------------

report() {
    local tool library found
    if ! compiler_is_fine; then
        found=$(compiler_version)
        complain "missing: gfortran 12 or newer${found:+ (found $found; FPM_FC may name another)}"
    fi
    for library in ${missing_libraries[@]+"${missing_libraries[@]}"}; do
        complain "missing: $library"
    done
    for tool in ${missing_tools[@]+"${missing_tools[@]}"}; do
        if [ -n "${tools:-}" ] && [ -x "$tools/bin/$tool" ]; then
            found=$(command -v "$tool")
            if [ "$found" -ef "$tools/bin/$tool" ]; then
                complain "$found does not start: $("$found" --version 2>&1 | tail -n 1)"
                continue
            fi
            complain "$tool is in $link_directory, but this shell finds ${found:-none};" \
                "type 'export PATH=\"$link_directory:\$PATH\"', then ./setup.sh again"
        elif [ "$tool" = fpm ]; then
            complain "missing: fpm 0.12 or newer, the Fortran package manager"
        else
            complain "missing: $tool"
        fi
    done
    if $cluster && ! { has caf && has cafrun; }; then
        complain "missing: caf and cafrun of OpenCoarrays"
    fi
    if $ready; then
        has gnuplot || say "no gnuplot: everything works, but plots are not drawn"
        say "ready: gfortran $(compiler_version), fpm $(fpm_version), LAPACK, BLAS, GSL"
        return 0
    fi
    if ! has apt-get; then
        cat >&2 <<'END'
setup: this script installs on Debian and its relatives only. By hand, from your own packages:
         gfortran 12 or newer
         LAPACK and BLAS (OpenBLAS, thread-safe, or the reference ones), with the files to link
         GSL, the GNU Scientific Library, with the files to link
         fpm 0.12, the Fortran package manager: https://fpm.fortran-lang.org/install
         gnuplot (optional, draws the plots)
       With conda: conda install -c conda-forge gfortran liblapack libblas gsl fpm gnuplot
END
    fi
    return 1
}

install_program() { # build, and put everything below $prefix
    local program=$prefix/bin/lagrangia
    cd "$(dirname "$0")" || return 1
    takes "fpm install --profile release --prefix $prefix: compiling takes some minutes the first time" \
        fpm install --profile release --prefix "$prefix" || {
        tail -n 15 "$trial/step.log" >&2
        complain "fpm could not install lagrangia"
        return 1
    }
    mkdir -p "$prefix/share/man/man1" "$prefix/share/bash-completion/completions" \
        "$prefix/share/zsh/site-functions" &&
        "$program" manual >"$prefix/share/man/man1/lagrangia.1" &&
        "$program" completion bash >"$prefix/share/bash-completion/completions/lagrangia" &&
        "$program" completion zsh >"$prefix/share/zsh/site-functions/_lagrangia" || return 1
    say "installed: $program"
    [ "$(command -v lagrangia)" -ef "$program" ] ||
        say "type 'export PATH=\"$prefix/bin:\$PATH\"' so that shells find it"
}

prefix=
for argument in "$@"; do
    case $argument in
        --dev) dev=true ;;
        --cluster) cluster=true ;;
        install) prefix=$HOME/.local ;;
        -h | --help) usage; exit 0 ;;
        *)
            if [ -z "$prefix" ] || [[ $argument == -* ]]; then
                printf 'setup: unknown word %s\n' "'$argument'" >&2; usage >&2; exit 2
            fi
            prefix=$argument
            ;;
    esac
done

trial=$(mktemp -d) || exit 1
trap 'rm -rf "$trial"' EXIT
echo 'end program' >"$trial/trial.f90"

find_missing
if ! nothing_missing; then
    find_privilege
    if [ ${#missing_packages[@]} -gt 0 ]; then
        install_packages
        find_missing
    fi
    $asked && exit 1
    if [ ${#missing_tools[@]} -gt 0 ]; then
        install_tools
        find_missing
    fi
fi
report || exit 1
[ -n "$prefix" ] || exit 0
install_program
