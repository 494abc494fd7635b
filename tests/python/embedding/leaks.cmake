# Given to a project as CMAKE_PROJECT_tool_INCLUDE: fails where embedding curvewise has changed
# anything of that project, and compiles its target `tool` with warnings that our headers, were they
# not SYSTEM, would not have to meet.

get_cmake_property(names_before CACHE_VARIABLES)
foreach(name IN LISTS names_before)
  set(before_${name} "$CACHE{${name}}")
endforeach()

function(check_leaks)
  foreach(name IN LISTS names_before)
    # What CMake itself counts and prints.
    if(NOT "$CACHE{${name}}" STREQUAL "${before_${name}}" AND NOT name MATCHES "^(CMAKE_CACHE|FIND_)")
      message(SEND_ERROR "${name} was '${before_${name}}' and is '$CACHE{${name}}'")
    endif()
  endforeach()
  get_cmake_property(names CACHE_VARIABLES)
  list(REMOVE_ITEM names ${names_before})
  # Our options, what project() notes, and what find_package found.
  list(FILTER names EXCLUDE REGEX "^(CURVEWISE_|curvewise_|FETCHCONTENT_|Eigen3_DIR|FIND_PACKAGE_)")
  list(FILTER names EXCLUDE REGEX "^CMAKE_(HAVE_(LIBC_)?PTHREAD|PROJECT_VERSION)")
  if(names)
    message(SEND_ERROR "new in the cache: ${names}")
  endif()
  foreach(property IN ITEMS COMPILE_OPTIONS COMPILE_DEFINITIONS LINK_OPTIONS INCLUDE_DIRECTORIES)
    get_directory_property(value ${property})
    if(value)
      message(SEND_ERROR "${property} of the project: ${value}")
    endif()
  endforeach()
  foreach(property IN ITEMS INTERFACE_COMPILE_OPTIONS INTERFACE_LINK_OPTIONS)
    get_target_property(value curvewise::curvewise ${property})
    if(value)
      message(SEND_ERROR "${property} of curvewise: ${value}")
    endif()
  endforeach()
  target_compile_options(tool PRIVATE -Wall -Wextra -Wconversion -Weffc++ -Wpadded -Werror)
endfunction()
cmake_language(DEFER CALL check_leaks)
