# Sourced by the scripts: installs what is missing, builds what is not fresh. Everything it says goes to stderr.
# A failure ends with status 69, which the program itself never returns.

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.." && pwd)
readonly root

# An interrupted build is no failed one. A subshell has to say so again.
heed_signals() {
  trap 'exit 130' INT
  trap 'exit 143' TERM
}
heed_signals

say() { printf '%s: %s\n' "$(basename -- "$0")" "$*" >&2; }

fail() {
  say "$@"
  exit 69
}

# missing_packages KIND...: the packages of these kinds that are not installed.
missing_packages() {
  local wanted present
  wanted=$(awk -v kinds=" $* " '!/^#/ && index(kinds, " " $2 " ") { print $1 }' "$root/scripts/packages.txt")
  # shellcheck disable=SC2086
  present=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $wanted 2>/dev/null | sed -n 's/^installed //p')
  grep -vxF -f <(printf '%s\n' "$present") <<<"$wanted" | tr '\n' ' '
}

# ensure_packages KIND...: as root installs what is missing. Nobody else's machine is changed: others are told what to run.
ensure_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say "this is not Debian: scripts/packages.txt names what has to be installed"
    return
  fi
  local missing
  missing=$(missing_packages "$@")
  missing=${missing% }
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    say "missing packages: $missing"
    fail "install them with: sudo apt-get install --no-install-recommends $missing"
  fi
  say "installing $missing"
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 -y)
  "${apt[@]}" update >&2 </dev/null || say "the package lists could not be refreshed; trying with those at hand"
  # shellcheck disable=SC2086
  "${apt[@]}" install --no-install-recommends $missing >&2 </dev/null || fail "could not install: $missing"
}

# The packages of the list that are installed: optional ones are looked for when configuring.
installed_packages() {
  # shellcheck disable=SC2046
  dpkg-query -W -f='${db:Status-Status} ${Package}\n' $(awk '!/^#/ { print $1 }' "$root/scripts/packages.txt") 2>/dev/null | sed -n 's/^installed //p'
}

# Configures when that was never done, when the presets or the installed packages changed, or when the tree has moved since.
configure() {
  local tree=$root/build/$1 fresh=() packages
  packages=$(installed_packages)
  if [ "$packages" != "$(cat "$tree/.packages" 2>/dev/null)" ]; then rm -f "$tree/build.ninja"; fi
  if [ -f "$tree/CMakeCache.txt" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$tree/CMakeCache.txt"; then
    fresh=(--fresh)
  elif [ -f "$tree/build.ninja" ] && [ ! "$root/CMakePresets.json" -nt "$tree/build.ninja" ]; then
    return 0
  fi
  say "configuring build/$1"
  (cd -- "$root" && cmake --preset "$1" "${fresh[@]}") >"$tree/configure.log" 2>&1 </dev/null &&
    printf '%s' "$packages" >"$tree/.packages" && return 0
  tail -n 40 "$tree/configure.log" >&2
  return 1
}

# Silent when there is little to do: the note of the commit is looked at each time.
compile() {
  local tree=$root/build/$1 quiet=(--quiet)
  shift
  # Of a tree that has compiled nothing yet a dry run tells only that the lists of files are looked at first.
  if ! grep -qs '\.o	' "$tree/.ninja_log" ||
    [ "$(ninja -C "$tree" -n "$@" 2>/dev/null </dev/null | grep -c 'Building CXX')" -gt 1 ]; then
    say "building ${tree#"$root/"}; from scratch this takes some minutes"
    quiet=()
  fi
  ninja -C "$tree" -j "$(nproc)" "${quiet[@]}" "$@" >&2 </dev/null
}

# prepare PRESET KIND... -- [TARGET...]: packages, then build. One at a time, however many start at once.
prepare() {
  local preset=$1 kinds=()
  shift
  while [ "$1" != -- ]; do
    kinds+=("$1")
    shift
  done
  shift
  mkdir -p "$root/build/$preset" || fail "cannot write to $root/build"
  (
    heed_signals
    flock 9
    ensure_packages "${kinds[@]}"
    configure "$preset" || fail "could not configure build/$preset"
    compile "$preset" "$@" || fail "could not build build/$preset"
  ) 9>"$root/build/.$preset.lock" || exit
}
