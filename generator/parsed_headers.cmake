# Headers of libraries take longer to parse than most of our sources. g++ parses them once for all sources that share a set.
#
# CMake's own way names the parsed form by its path in every command, which clang's tools take for one of theirs and refuse.
# Here a command names a header on its include path, and g++ finds the parsed form beside it; clang finds the header, and
# nothing in it.

# A set of headers, of libraries as <header>; LIBRARIES say where they are.
function(jourdain_parsed_headers name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS;LIBRARIES")
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    return()
  endif()
  list(TRANSFORM arg_HEADERS REPLACE "^([^<].*)$" "\"\\1\"")
  list(TRANSFORM arg_HEADERS PREPEND "#include ")
  list(JOIN arg_HEADERS "\n" includes)
  set(base ${PROJECT_BINARY_DIR}/parsed_headers/${name})
  file(CONFIGURE OUTPUT ${base}.hpp CONTENT "#ifndef __clang__\n${includes}\n#endif\n")
  file(CONFIGURE OUTPUT ${base}.cpp CONTENT "")
  add_library(jourdain_parsed_${name} OBJECT ${base}.cpp)
  target_precompile_headers(jourdain_parsed_${name} PRIVATE ${base}.hpp)
  target_link_libraries(jourdain_parsed_${name} PRIVATE ${arg_LIBRARIES} jourdain_flags)
endfunction()

# Sources of `target` start with the set `name`. What they include themselves stays as it is: clang sees no set. Options that
# change code, such as -O2, must be those of jourdain_parsed_<name>: g++ may crash otherwise.
function(jourdain_starts_with target name)
  if(NOT TARGET jourdain_parsed_${name})
    return()
  endif()
  get_target_property(folder jourdain_parsed_${name} BINARY_DIR)
  string(APPEND folder /CMakeFiles/jourdain_parsed_${name}.dir)
  target_compile_options(${target} PRIVATE -I${folder} -include cmake_pch.hxx -Winvalid-pch)
  # What g++ says a source depends on lacks what it took from the parsed form: ccache's depend mode would find wrong results.
  get_target_property(sources ${target} SOURCES)
  get_target_property(directory ${target} SOURCE_DIR)
  list(TRANSFORM sources REPLACE "^([^/].*)" "${directory}/\\1")
  set_property(SOURCE ${sources} TARGET_DIRECTORY ${target} APPEND PROPERTY OBJECT_DEPENDS
               ${folder}/cmake_pch.hxx.gch)
endfunction()
