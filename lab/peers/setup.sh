#!/bin/bash
# Installs peers with the ordinary clients of pip and apt: setup.sh [pinocchio] [mujoco] [robots] [exudyn] [andrews] [drake] [simbody]
# Without names: the first five. The crates among the peers need nothing: cargo fetches them when they are built.
set -e
here=$(cd "$(dirname "$0")" && pwd)
folder=${PEERS_DIR:-${CARGO_TARGET_DIR:-$here/../../target}/peers}
mkdir -p "$folder"
[ -x "$folder/venv/bin/pip" ] || python3 -m venv "$folder/venv"

python_packages() { "$folder/venv/bin/pip" install --quiet "$@"; }

debian_packages() {
  local as_root=""
  [ "$(id -u)" = 0 ] || as_root=sudo
  $as_root apt-get update -q
  $as_root apt-get -o DPkg::Lock::Timeout=300 install -y --no-install-recommends "$@"
}

[ $# -gt 0 ] || set -- pinocchio mujoco robots exudyn andrews
for peer in "$@"; do
  case $peer in
    pinocchio) python_packages numpy pin==4.1.0 cmeel-eigen==3.4.1 ;;
    mujoco)    python_packages numpy mujoco==4.0.0 ;;
    robots)
      # Their data alone is read.
      python_packages numpy pin==4.1.0 mujoco==4.0.0
      "$folder/venv/bin/pip" download --quiet --no-deps --dest "$folder/wheels" example-robot-data==6.0.0
      "$folder/venv/bin/python" -m zipfile -e "$folder"/wheels/example_robot_data-*.whl "$folder/data"
      "$folder/venv/bin/python" "$here/robots.py" "$folder/data" "$folder/robots" ;;
    exudyn)    python_packages numpy scipy exudyn==1.13.6 ;;
    andrews)   debian_packages gcc r-cran-desolve libsundials-dev ;;
    drake)     python_packages numpy drake==1.51.1 ;;
    simbody)   debian_packages g++ libsimbody-dev ;;
    *) echo "setup.sh: unknown peer '$peer'" >&2; exit 1 ;;
  esac
done
