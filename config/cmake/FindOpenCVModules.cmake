# Debian's libopencv-dev, which carries OpenCV's own CMake files, also pulls in VTK, OpenMPI and the
# rest (over 300 MB). The few modules used here come from their own -dev packages, so they are found
# directly and offered under the names that OpenCV 5 will use: OpenCV::core, OpenCV::video, ...
find_path(OpenCVModules_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(OpenCVModules_REQUIRED_LIBS "")
foreach(module IN LISTS OpenCVModules_FIND_COMPONENTS)
  find_library(OpenCVModules_${module}_LIBRARY opencv_${module})
  list(APPEND OpenCVModules_REQUIRED_LIBS OpenCVModules_${module}_LIBRARY)
  if(OpenCVModules_${module}_LIBRARY AND NOT TARGET OpenCV::${module})
    add_library(OpenCV::${module} SHARED IMPORTED)
    set_target_properties(
      OpenCV::${module}
      PROPERTIES IMPORTED_LOCATION "${OpenCVModules_${module}_LIBRARY}"
                 INTERFACE_INCLUDE_DIRECTORIES "${OpenCVModules_INCLUDE_DIR}")
  endif()
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  OpenCVModules REQUIRED_VARS OpenCVModules_INCLUDE_DIR ${OpenCVModules_REQUIRED_LIBS})
mark_as_advanced(OpenCVModules_INCLUDE_DIR ${OpenCVModules_REQUIRED_LIBS})
