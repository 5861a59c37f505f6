#!/bin/bash
# Builds the peers' programs of C and C++ that are missing or older than their source, where their library is installed.
# Peers are built as their users would for speed: -O3 -march=native. A library that is not there is passed over in silence.
here=$(cd "$(dirname "$0")" && pwd)
folder=${PEERS_DIR:-${CARGO_TARGET_DIR:-$here/../../target}/peers}
packages=$(echo "$folder"/venv/lib/python3*/site-packages)
fast="-O3 -march=native -DNDEBUG"
failed=0

# build PROGRAM NEEDED-FILE SOURCES -- COMPILER ARGUMENTS
build() {
  local program=$folder/$1 needed=$2 stale=no
  shift 2
  [ -e "$needed" ] || return 0
  while [ "$1" != -- ]; do [ "$program" -nt "$here/$1" ] || stale=yes; shift; done
  shift
  [ $stale = no ] || { echo "building $(basename "$program")" >&2; "$@" -o "$program" || failed=1; }
}

p=$packages/cmeel.prefix
boost="-DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_LIMIT_VECTOR_SIZE=30 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS
  -DBOOST_FUSION_INVOKE_MAX_ARITY=12 -DPINOCCHIO_ENABLE_COMPATIBILITY_WITH_VERSION_3"
for part in open loop robot; do
  # Header-only: the wheel's compiled library is for plain x86-64, and mixing breaks Eigen's alignment.
  build pinocchio_$part "$p/include/pinocchio/multibody.hpp" pinocchio/$part.cpp pinocchio/common.hpp -- \
    g++ -std=c++17 $fast $boost -w -I"$p/include" -I"$p/include/eigen3" "$here/pinocchio/$part.cpp" \
    -L"$p/lib" -lboost_serialization -Wl,-rpath,"$p/lib"
done

m=$packages/mujoco
build mujoco "$m/include/mujoco/mujoco.h" mujoco/forward.c mujoco/clock.h -- \
  gcc $fast "$here/mujoco/forward.c" -I"$m/include" $(echo "$m"/libmujoco.so.*) -Wl,-rpath,"$m" -lm
build mujoco_robot "$m/include/mujoco/mujoco.h" mujoco/robot.c mujoco/clock.h -- \
  gcc $fast "$here/mujoco/robot.c" -I"$m/include" $(echo "$m"/libmujoco.so.*) -Wl,-rpath,"$m" -lm

build andrews_ida /usr/include/ida/ida.h andrews/ida.c andrews/andrews.h -- \
  gcc $fast "$here/andrews/ida.c" -lsundials_ida -lsundials_nvecserial -lsundials_sunmatrixdense -lsundials_sunlinsoldense -lm
build andrews_radau.so /usr/lib/R/site-library/deSolve andrews/radau.c andrews/andrews.h -- \
  gcc $fast -fPIC -shared "$here/andrews/radau.c" -lm

# Simbody without -DNDEBUG: Debian's library was built without it, and classes have another layout with it.
build simbody /usr/include/simbody/Simbody.h simbody/simbody.cpp -- \
  g++ -std=c++17 -O3 -march=native -w -I/usr/include/simbody "$here/simbody/simbody.cpp" -lSimTKsimbody -lSimTKmath -lSimTKcommon
exit $failed
