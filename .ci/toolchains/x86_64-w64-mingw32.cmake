# 64-bit Windows from Debian's cross-compiler, with POSIX threads, run by wine:
# apt install g++-mingw-w64-x86-64-posix wine64
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")  # the compiler's own libraries, too
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
