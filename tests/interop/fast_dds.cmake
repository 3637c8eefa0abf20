# fast_dds_types(NAME IDL STEM): a library of the types that Fast DDS's own generator makes of an
# IDL file called STEM.idl.
function(fast_dds_types name idl stem)
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/generated")
  set(sources "${generated}/${stem}.cxx" "${generated}/${stem}PubSubTypes.cxx")
  # Named, so that what includes them is compiled anew in the build that makes them anew.
  set(headers "${generated}/${stem}.h" "${generated}/${stem}PubSubTypes.h")
  file(MAKE_DIRECTORY "${generated}")
  add_custom_command(
    OUTPUT ${sources} ${headers}
    COMMAND "${FASTDDSGEN}" -replace -d "${generated}" "${idl}"
    DEPENDS "${idl}"
    COMMENT "Fast DDS types of ${stem}.idl"
    VERBATIM)
  # Outside our warnings.
  add_library(${name} STATIC ${sources})
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_compile_options(${name} PRIVATE -w)
  target_include_directories(${name} SYSTEM PUBLIC "${generated}")
  target_link_libraries(${name} PUBLIC fastrtps fastcdr)
endfunction()

# fast_dds_program(NAME TYPES SOURCE...): a program over such types. It has no include path of ours:
# what it knows of Trailcast it knows from the IDL.
function(fast_dds_program name types)
  add_executable(${name} ${ARGN})
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Werror -Wshadow)
  target_include_directories(${name} PRIVATE "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/fast_dds_shared")
  target_link_libraries(${name} PRIVATE ${types})
endfunction()
