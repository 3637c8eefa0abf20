# Debian's libpqxx-dev has no CMake files.
find_path(Pqxx_INCLUDE_DIR pqxx/pqxx)
find_library(Pqxx_LIBRARY pqxx)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Pqxx REQUIRED_VARS Pqxx_INCLUDE_DIR Pqxx_LIBRARY)
if(Pqxx_FOUND AND NOT TARGET Pqxx::pqxx)
  add_library(Pqxx::pqxx SHARED IMPORTED)
  set_target_properties(Pqxx::pqxx PROPERTIES IMPORTED_LOCATION "${Pqxx_LIBRARY}"
                                              INTERFACE_INCLUDE_DIRECTORIES "${Pqxx_INCLUDE_DIR}")
endif()
mark_as_advanced(Pqxx_INCLUDE_DIR Pqxx_LIBRARY)
