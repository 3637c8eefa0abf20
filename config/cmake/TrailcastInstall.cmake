# `cmake --install`, the CMake package `trailcast` for those who build on the libraries, and Debian
# packages (`cpack` in a build folder): a robot's agent, the route server, the operator's tools, and
# what compiles against the libraries.

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)
set(modules "${CMAKE_INSTALL_LIBDIR}/trailcast")
install(TARGETS trailcast-agent COMPONENT agent)
install(TARGETS trailcast-server COMPONENT server)
install(TARGETS trailcast trailcast-console trailcast-vda5050 COMPONENT tools)
install(TARGETS trailcast_codecs trailcast_simulated_module LIBRARY DESTINATION "${modules}"
                                                            COMPONENT tools)
install(FILES config/systemd/trailcast-server.service DESTINATION lib/systemd/system
        COMPONENT server)
install(FILES config/systemd/trailcast-agent.service DESTINATION lib/systemd/system
        COMPONENT agent)
install(PROGRAMS config/examples/send_and_wait.sh DESTINATION share/trailcast COMPONENT tools)
install(FILES config/systemd/trailcast-console.service config/systemd/trailcast-vda5050.service
        DESTINATION lib/systemd/system COMPONENT tools)
install(FILES config/route_server/server.toml DESTINATION share/trailcast COMPONENT server)
install(FILES config/grafana/trailcast.json config/prometheus/trailcast-alerts.yml
        DESTINATION share/trailcast COMPONENT tools)
install(FILES config/agent/agent.toml config/agent/camera.toml config/agent/car.toml
              config/agent/differential.toml config/agent/tracked.toml DESTINATION share/trailcast
        COMPONENT agent)

# Man pages, made of what each program explains of itself, by the target `manpages`; and completion
# for bash, fish and zsh, which asks the programs. Each shell looks for a file of the program's name;
# Debian's zsh looks in vendor-completions below /usr, and in site-functions below /usr/local.
find_program(Gzip gzip REQUIRED)
set(pages)
foreach(program trailcast trailcast-agent trailcast-console trailcast-server trailcast-vda5050)
  set(component tools)
  if(program MATCHES "-(agent|server)$")
    set(component "${CMAKE_MATCH_1}")
  endif()
  set(page "${PROJECT_BINARY_DIR}/man/${program}.1")
  add_custom_command(
    OUTPUT "${page}.gz"
    COMMAND "${PROJECT_SOURCE_DIR}/config/cmake/man_page.sh" "$<TARGET_FILE:${program}>" > "${page}"
    COMMAND "${Gzip}" --force --no-name --best "${page}"
    DEPENDS ${program} config/cmake/man_page.sh
    VERBATIM)
  list(APPEND pages "${page}.gz")
  install(FILES "${page}.gz" DESTINATION share/man/man1 COMPONENT ${component} OPTIONAL)
  install(FILES config/completion/trailcast.bash DESTINATION share/bash-completion/completions
          RENAME ${program} COMPONENT ${component})
  install(FILES config/completion/trailcast.fish DESTINATION share/fish/vendor_completions.d
          RENAME ${program}.fish COMPONENT ${component})
  foreach(folder vendor-completions site-functions)
    install(FILES config/completion/trailcast.zsh DESTINATION share/zsh/${folder}
            RENAME _${program} COMPONENT ${component})
  endforeach()
endforeach()
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/man")
add_custom_target(manpages DEPENDS ${pages})

# The rooms that are offered: to teach and follow, to store, share and look for routes.
set(rooms services/base services/motion services/image services/route services/view
          services/vision services/teach services/replay services/refresh services/belief services/mission services/network
          services/store services/exchange services/archive services/catalog services/security
          services/dds agent/session)
set(targets trailcast_route_format trailcast_wire_types trailcast_ros2_types)
foreach(room IN LISTS rooms)
  get_filename_component(name "${room}" NAME)
  list(APPEND targets "trailcast_${name}")
  install(
    DIRECTORY "${room}"
    DESTINATION "include/trailcast/$<IF:$<STREQUAL:${name},session>,agent,services>"
    FILES_MATCHING PATTERN "*.h"
    PATTERN src EXCLUDE)
endforeach()
foreach(target IN LISTS targets)
  string(REGEX REPLACE "^trailcast_" "" name "${target}")
  set_target_properties(${target} PROPERTIES EXPORT_NAME "${name}")
endforeach()
add_custom_target(offered DEPENDS ${targets})
install(TARGETS ${targets} EXPORT trailcast ARCHIVE DESTINATION "${modules}")
install(EXPORT trailcast NAMESPACE trailcast:: DESTINATION "${modules}/cmake"
        FILE trailcast-targets.cmake)

include(CMakePackageConfigHelpers)
file(WRITE "${PROJECT_BINARY_DIR}/trailcast-config.cmake"
     [=[# find_package(trailcast): the libraries trailcast::session, trailcast::dds, ...
include(CMakeFindDependencyMacro)
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
find_dependency(Threads)
find_dependency(fmt)
find_dependency(tl-expected)
find_dependency(Eigen3 NO_MODULE)
find_dependency(OpenCVModules COMPONENTS core imgproc imgcodecs video features2d videoio calib3d)
find_dependency(JPEG)
find_dependency(Protobuf)
find_dependency(OpenSSL COMPONENTS Crypto)
find_dependency(SQLite3)
find_dependency(SQLiteCpp)
find_dependency(Pqxx)
find_dependency(CycloneDDS)
include("${CMAKE_CURRENT_LIST_DIR}/trailcast-targets.cmake")
]=])
write_basic_package_version_file("${PROJECT_BINARY_DIR}/trailcast-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(
  FILES "${PROJECT_BINARY_DIR}/trailcast-config.cmake"
        "${PROJECT_BINARY_DIR}/trailcast-config-version.cmake"
        config/cmake/FindOpenCVModules.cmake config/cmake/FindPqxx.cmake
  DESTINATION "${modules}/cmake")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Trailcast <trailcast@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Paths that robots share: taught once, followed by all")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES TRUE)
set(CPACK_DEB_COMPONENT_INSTALL TRUE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS TRUE)
set(CPACK_DEBIAN_AGENT_PACKAGE_NAME trailcast-agent)
set(CPACK_DEBIAN_SERVER_PACKAGE_NAME trailcast-server)
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME trailcast-tools)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libtrailcast-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS FALSE)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "trailcast-tools, cyclonedds-dev, libeigen3-dev, libexpected-dev, libjpeg-dev, libopencv-core-dev, \
libopencv-imgproc-dev, libopencv-imgcodecs-dev, libopencv-video-dev, libopencv-features2d-dev, \
libopencv-videoio-dev, libopencv-calib3d-dev, libpqxx-dev, libprotobuf-dev, libspdlog-dev, \
libsqlitecpp-dev, libssl-dev")
include(CPack)
