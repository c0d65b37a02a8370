# What Vantage is built and tested with: the one list of Debian 12 packages, and its installation.
# Sourced by the scripts that build; needs bash.

vantage_packages=(
  # building
  g++ cmake ninja-build ccache
  # libraries
  libvtk9-dev python3-vtk9 libpython3-dev libembree-dev libopenmesh-dev libglm-dev libtbb-dev
  libeigen3-dev libcli11-dev nlohmann-json3-dev libopenexr-dev
  python3-imath # no use of ours, but the CMake package of libopenexr-dev asks for its library
  libx11-dev # a window
  # drawing without a display or a graphics card: EGL, a virtual display, Mesa's software renderer
  libegl-dev libegl-mesa0 xvfb xauth libgl1-mesa-dri
  # testing
  libgtest-dev python3 clang-format-14 shellcheck
)

# Prints those of the packages given that are not installed, one a line.
missing_packages()
{
  local package
  for package in "$@"; do
    grep --quiet --line-regexp installed \
      <<<"$(dpkg-query --show --showformat='${db:Status-Status}\n' "$package" 2>/dev/null)" ||
      echo "$package"
  done
}

# Installs what is missing of the packages above, as root or through sudo; quick when nothing is.
install_packages()
{
  local missing
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "error: this is not Debian; install what Debian 12 calls: ${vantage_packages[*]}" >&2
    return 1
  fi
  mapfile -t missing < <(missing_packages "${vantage_packages[@]}")
  if ((${#missing[@]} == 0)); then
    return 0
  fi
  echo "Installing: ${missing[*]}"
  local as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "error: neither root nor sudo; run as root: apt-get install ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update --quiet=2 &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install --yes --quiet=2 --no-install-recommends "${missing[@]}" >/dev/null ||
    return 1
  mapfile -t missing < <(missing_packages "${vantage_packages[@]}")
  if ((${#missing[@]} != 0)); then
    echo "error: apt-get did not install: ${missing[*]}" >&2
    return 1
  fi
}
