# The measuring is built twice: for any processor and, with wide vectors, for x86-64-v3. A program
# names neither. The dynamic loader looks for its library in glibc-hwcaps/x86-64-v3 first, beside
# the plain one, if the processor can run what lies there (ld.so(8)). A library of its own is needed:
# in one program the linker keeps one copy of a template of Eigen's, whichever it met.
#
#   GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2 instep girth ...   as on a processor without them
set(INSTEP_WIDE_VECTORS AUTO CACHE STRING
  "Build the measuring for x86-64-v3 as well: ON, OFF, or AUTO, where it is optimised and not sanitized")
string(TOUPPER "${INSTEP_WIDE_VECTORS}" wide_vectors)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
if(wide_vectors STREQUAL "AUTO")
  set(wide_vectors OFF)
  # Whoever names a processor has the library built for it alone.
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" AND CMAKE_SIZEOF_VOID_P EQUAL 8
     AND build_type MATCHES "^(RELEASE|RELWITHDEBINFO|MINSIZEREL)$" AND NOT INSTEP_SANITIZE
     AND NOT CMAKE_CXX_FLAGS MATCHES "-march=")
    set(wide_vectors ON)
  endif()
elseif(NOT wide_vectors MATCHES "^(ON|OFF|TRUE|FALSE|YES|NO|1|0)$")
  message(FATAL_ERROR "INSTEP_WIDE_VECTORS is ${INSTEP_WIDE_VECTORS}: give ON, OFF or AUTO")
endif()

# Where programs that are installed find their library.
set(core_folder "${CMAKE_INSTALL_LIBDIR}/instep")
set(wide_place glibc-hwcaps/x86-64-v3)
file(RELATIVE_PATH core_from_programs
  "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}/instep")
if(NOT DEFINED CMAKE_INSTALL_RPATH)
  set(CMAKE_INSTALL_RPATH "$ORIGIN/${core_from_programs}")
endif()

# What the library allocates a program's headers may free. With wide vectors Eigen 3.4 allocates for
# 32 bytes whatever it is told, and without them takes what malloc gives: so both are told 32, and 16
# for what has a fixed size. Each library calls its own code.
function(one_of_two_builds target processors place)
  target_compile_definitions(${target} PUBLIC
    EIGEN_MAX_ALIGN_BYTES=32 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  target_link_options(${target} PRIVATE -Wl,-Bsymbolic-functions)
  target_link_libraries(${target} PRIVATE nanoflann::nanoflann)
  set_target_properties(${target} PROPERTIES
    OUTPUT_NAME instep_core INSTALL_RPATH "" INSTEP_PROCESSORS "${processors}"
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/${place}")
  install(TARGETS ${target} LIBRARY DESTINATION "${core_folder}/${place}")
endfunction()

set_source_files_properties(core/built_for.cpp PROPERTIES COMPILE_DEFINITIONS
  "INSTEP_BUILT_FOR=\"$<TARGET_PROPERTY:INSTEP_PROCESSORS>\"")
one_of_two_builds(instep_core "any processor" "")
if(wide_vectors)
  get_target_property(sources instep_core SOURCES)
  add_library(instep_core_wide SHARED ${sources})
  # Products that are rounded one by one: what is a tie on one processor is one on all, such as the
  # two diagonals of a square that a mesh grows over. Eigen fuses its own all the same.
  target_compile_options(instep_core_wide PRIVATE -march=x86-64-v3 -ffp-contract=off)
  target_include_directories(instep_core_wide PRIVATE "${CMAKE_BINARY_DIR}/layers/core")
  target_link_libraries(instep_core_wide PRIVATE instep_flags Eigen3::Eigen tl::expected)
  one_of_two_builds(instep_core_wide "x86-64-v3" ${wide_place})
  # Whoever builds a program or a test gets both.
  add_dependencies(instep_core instep_core_wide)
else()
  # One of an earlier build or installation would go before the new one.
  file(REMOVE_RECURSE "${CMAKE_CURRENT_BINARY_DIR}/${wide_place}")
  set(installed_wide "${core_folder}/${wide_place}")
  if(NOT IS_ABSOLUTE "${installed_wide}")
    string(PREPEND installed_wide "\${CMAKE_INSTALL_PREFIX}/")
  endif()
  install(CODE "file(REMOVE_RECURSE \"\$ENV{DESTDIR}${installed_wide}\")")
endif()
