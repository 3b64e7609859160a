# Sourced by app/demo and tests/run: the packages that the build needs on Debian, and functions to install and build.

# What draws without a display: OSMesa up to Debian 13, EGL where Mesa has it no more. Testing has no VERSION_ID.
kDrawingPackages=(libegl1 libegl-mesa0 libgl1-mesa-dri)
[ "$(. /etc/os-release && echo "${VERSION_ID:-99}")" -gt 13 ] || kDrawingPackages=(libosmesa6)
kBuildPackages=(g++ cmake ninja-build pkg-config libeigen3-dev nlohmann-json3-dev libcli11-dev libdeflate-dev
  libpng-dev libzip-dev libpugixml-dev libstb-dev "${kDrawingPackages[@]}" libgl-dev libegl-dev libglfw3-dev
  fonts-dejavu-core)

# Installs those of the named packages that are missing, after listing them. It needs no network if none is missing.
install_missing() {
  local package missing=() as_root=()
  for package in "$@"; do
    [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  echo "About to install these Debian packages: ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "This user is not root, and sudo is not installed: install the packages, then run this again." >&2
      exit 3
    }
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
      "${missing[@]}" >/dev/null || {
    echo "The packages could not be installed." >&2
    exit 3
  }
}

# build_in FOLDER TARGET [CMAKE OPTION…]
build_in() {
  local folder=$1 target=$2
  shift 2
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@" >"$folder.log" 2>&1 ||
    { cat "$folder.log" >&2 && exit 3; }
  cmake --build "$folder" --target "$target"
}
