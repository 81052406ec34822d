# Everything floe takes from outside; Debian's package names stand beside each line.
include_guard()

find_package(PkgConfig REQUIRED)                           # pkg-config
find_package(Eigen3 3.4 REQUIRED NO_MODULE)                # libeigen3-dev
find_package(embree 3.12 REQUIRED)                         # libembree-dev
find_package(Ceres 2.1 REQUIRED)                           # libceres-dev
find_package(OpenMP REQUIRED COMPONENTS CXX)               # g++
# HDF5's module looks for a C compiler's settings.
enable_language(C)
find_package(HDF5 REQUIRED COMPONENTS C)                   # libhdf5-dev
find_package(ZLIB REQUIRED)                                # zlib1g-dev
find_package(fmt REQUIRED)                                 # libfmt-dev
find_package(CLI11 REQUIRED)                               # libcli11-dev
find_package(nlohmann_json 3.11 REQUIRED)                  # nlohmann-json3-dev
find_package(toml11 3.7 REQUIRED)                          # libtoml11-dev
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED) # librandom123-dev
find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)            # libxxhash-dev (header only)
if(FLOE_BUILD_TESTS)
  find_package(GTest REQUIRED)                             # libgtest-dev
endif()
if(FLOE_BUILD_BENCHMARKS)
  find_package(benchmark REQUIRED)                         # libbenchmark-dev
endif()
