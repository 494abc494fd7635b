# Fails where a file in the folder SOURCE (cpp) includes a file from a room above its own, and where
# files include each other in a circle. `floors` is the order of the rooms, the lowest first; rooms
# on the same floor do not include each other.
cmake_minimum_required(VERSION 3.21)
set(floors
  "include/curvewise"
  "src/runtime src/warping/kernels"
  "src/curves src/materials"
  "src/pairwise"
  "src/continuous src/planar src/warping"
  "src/nearest"
  "src/interface")

set(floor 0)
foreach(rooms IN LISTS floors)
  math(EXPR floor "${floor} + 1")
  separate_arguments(rooms)
  foreach(room IN LISTS rooms)
    set(floor_of_${room} ${floor})
  endforeach()
endforeach()

file(GLOB_RECURSE files RELATIVE ${SOURCE} ${SOURCE}/include/*.h* ${SOURCE}/src/*.[ch]pp)
list(LENGTH files count)
if(count LESS 100)
  message(FATAL_ERROR "${SOURCE} has only ${count} files")
endif()
foreach(file IN LISTS files)
  cmake_path(GET file PARENT_PATH room)
  file(STRINGS ${SOURCE}/${file} lines REGEX "^ *# *include +\"")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE ".*include +\"([^\"]+)\".*" "\\1" name "${line}")
    set(included ${name})
    foreach(place IN ITEMS include src ${room})  # a file's own folder counts first
      if(EXISTS ${SOURCE}/${place}/${name})
        set(included ${place}/${name})
      endif()
    endforeach()
    cmake_path(GET included PARENT_PATH its_room)
    if(NOT (DEFINED floor_of_${room} AND DEFINED floor_of_${its_room}))
      message(SEND_ERROR "${file} includes \"${name}\", and one of the two is in no room")
    elseif(NOT its_room STREQUAL room AND NOT floor_of_${its_room} LESS floor_of_${room})
      message(SEND_ERROR "${file} includes \"${name}\", from a room that is not below its own")
    endif()
    list(APPEND includes_of_${file} ${included})
  endforeach()
endforeach()

# A file that includes none of those left, or that none of them includes, is in no circle: such files
# are taken away until nothing changes.
while(NOT "${left}" STREQUAL "${files}")
  set(left ${files})
  set(needed)
  foreach(file IN LISTS left)
    list(APPEND needed ${includes_of_${file}})
  endforeach()
  foreach(file IN LISTS left)
    set(others ${includes_of_${file}})
    list(REMOVE_ITEM others ${left})
    if("${others}" STREQUAL "${includes_of_${file}}" OR NOT file IN_LIST needed)
      list(REMOVE_ITEM files ${file})
    endif()
  endforeach()
endwhile()
if(files)
  list(JOIN files "\n  " files)
  message(SEND_ERROR "a circle of includes:\n  ${files}")
endif()
