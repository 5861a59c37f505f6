#!/bin/bash
# Installs the judges of imported models and unpacks the packages that ship models: setup.sh [drake]
# All lies under target/models (or MODELS_DIR): venv with Pinocchio and MuJoCo, wheels, and data/PACKAGE with what the wheels hold.
set -e
here=$(cd "$(dirname "$0")" && pwd)
folder=${MODELS_DIR:-${CARGO_TARGET_DIR:-$here/../../target}/models}
mkdir -p "$folder/wheels" "$folder/data"
[ -x "$folder/venv/bin/pip" ] || python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet numpy scipy pin==4.1.0 mujoco==4.0.0
[ "$1" != drake ] || "$folder/venv/bin/pip" install --quiet drake==1.51.1

# Only their data is read, so nothing of them is built, installed or run.
packages="example-robot-data==6.0.0 gymnasium==1.4.0 gymnasium-robotics==1.4.2 airo-models==0.0.12 icub-models==3.2.0 dm_control==1.0.50"
"$folder/venv/bin/pip" download --quiet --no-deps --only-binary :all: --dest "$folder/wheels" $packages
# A wheel of pybullet exists for some versions of Python only; its data is the same in each.
"$folder/venv/bin/pip" download --quiet --no-deps --only-binary :all: --dest "$folder/wheels" \
  --python-version 311 --platform manylinux2014_x86_64 pybullet==3.2.7

for wheel in "$folder"/wheels/*.whl; do
  package=$(basename "$wheel" | cut -d- -f1)
  [ -d "$folder/data/$package" ] || "$folder/venv/bin/python" -m zipfile -e "$wheel" "$folder/data/$package"
done
echo "$folder"
