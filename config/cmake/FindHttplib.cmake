# Debian's libcpp-httplib-dev is compiled, and has no CMake files: whoever includes its header must say
# what it was compiled with (its pkg-config file has the same list).
find_path(Httplib_INCLUDE_DIR httplib.h)
find_library(Httplib_LIBRARY cpp-httplib)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Httplib REQUIRED_VARS Httplib_INCLUDE_DIR Httplib_LIBRARY)
if(Httplib_FOUND AND NOT TARGET httplib::httplib)
  add_library(httplib::httplib SHARED IMPORTED)
  set_target_properties(
    httplib::httplib
    PROPERTIES
      IMPORTED_LOCATION "${Httplib_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${Httplib_INCLUDE_DIR}"
      INTERFACE_COMPILE_DEFINITIONS
      "CPPHTTPLIB_OPENSSL_SUPPORT;CPPHTTPLIB_ZLIB_SUPPORT;CPPHTTPLIB_BROTLI_SUPPORT")
  target_link_libraries(httplib::httplib INTERFACE Threads::Threads OpenSSL::Crypto)
endif()
mark_as_advanced(Httplib_INCLUDE_DIR Httplib_LIBRARY)
