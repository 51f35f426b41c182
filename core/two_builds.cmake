# The measuring is built twice: for any processor and, with wide vectors, for x86-64-v3. A program
# names neither. The dynamic loader looks for its library in glibc-hwcaps/x86-64-v3 first, beside
# the plain one, if the processor can run what lies there (ld.so(8)). A library of its own is needed:
# in one program the linker keeps one copy of a template of Eigen's, whichever it met.
#
#   GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2 instep girth ...   as on a processor without them

# What one library allocates the other may free, so both align alike; and each calls its own code.
target_compile_definitions(instep_core PUBLIC EIGEN_MAX_ALIGN_BYTES=16)
target_compile_options(instep_core PRIVATE -fno-semantic-interposition)
target_link_options(instep_core PRIVATE -Wl,-Bsymbolic-functions)
set(core_folder "${CMAKE_INSTALL_LIBDIR}/instep")
install(TARGETS instep_core LIBRARY DESTINATION "${core_folder}")
file(RELATIVE_PATH core_from_programs "/${CMAKE_INSTALL_BINDIR}" "/${core_folder}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/${core_from_programs}")

set(wide_is_sensible OFF)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" AND CMAKE_BUILD_TYPE STREQUAL "Release")
  set(wide_is_sensible ON)
endif()
option(INSTEP_WIDE_VECTORS "Build the measuring for x86-64-v3 as well" ${wide_is_sensible})
if(INSTEP_WIDE_VECTORS)
  get_target_property(sources instep_core SOURCES)
  add_library(instep_core_wide SHARED ${sources})
  target_compile_definitions(instep_core_wide PRIVATE EIGEN_MAX_ALIGN_BYTES=16)
  target_compile_options(instep_core_wide PRIVATE -march=x86-64-v3 -fno-semantic-interposition)
  target_link_options(instep_core_wide PRIVATE -Wl,-Bsymbolic-functions)
  target_include_directories(instep_core_wide PRIVATE "${CMAKE_BINARY_DIR}/layers/core")
  target_link_libraries(instep_core_wide
    PRIVATE instep_flags Eigen3::Eigen tl::expected nanoflann::nanoflann)
  set(place glibc-hwcaps/x86-64-v3)
  set_target_properties(instep_core_wide PROPERTIES
    OUTPUT_NAME instep_core INSTALL_RPATH ""
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/${place}")
  # Whoever builds a program or a test gets both.
  add_dependencies(instep_core instep_core_wide)
  install(TARGETS instep_core_wide LIBRARY DESTINATION "${core_folder}/${place}")
endif()
