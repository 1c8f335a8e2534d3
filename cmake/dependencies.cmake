# Everything comes from Debian bookworm's packages (scripts/packages.txt). What a library of ours links here, a consumer
# of the installed package needs too: see cmake/dualdamp-config.cmake.in.

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
set(CMAKE_MESSAGE_LOG_LEVEL WARNING)  # SuiteSparse lists twenty files, QUIET or not
find_package(Ceres REQUIRED)
find_package(MPI QUIET COMPONENTS CXX)  # optional: several processes share a campaign
unset(CMAKE_MESSAGE_LOG_LEVEL)
pkg_check_modules(udunits REQUIRED IMPORTED_TARGET udunits)
pkg_search_module(hdf5 REQUIRED IMPORTED_TARGET hdf5-serial hdf5)  # the one that matio is built over
pkg_check_modules(matio REQUIRED IMPORTED_TARGET matio)
pkg_check_modules(sleef REQUIRED IMPORTED_TARGET sleef)
find_path(RANDOM123_INCLUDE Random123/philox.h REQUIRED)

# For core::libraries(): name and version of each, sorted by name.
set(DUALDAMP_LIBRARIES
  "Boost ${Boost_VERSION}" "CLI11 ${CLI11_VERSION}" "Ceres ${Ceres_VERSION}" "Eigen ${Eigen3_VERSION}"
  "OpenSSL ${OPENSSL_VERSION}" "SLEEF ${sleef_VERSION}" "TBB ${TBB_VERSION}" "fmt ${fmt_VERSION}"
  "matio ${matio_VERSION}" "nlohmann-json ${nlohmann_json_VERSION}" "udunits2 ${udunits_VERSION}" "yaml-cpp ${yaml-cpp_VERSION}")
