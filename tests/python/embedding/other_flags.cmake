# Given to a project as CMAKE_PROJECT_tool_INCLUDE: all that it compiles, curvewise too, is compiled
# with flags that would change numbers, if the library let them. Not linked with them: gcc before
# 13 then has the shared library switch off subnormal numbers in every process that loads it.
add_compile_options(-Ofast -march=native)
