/* CURVEWISE_EXPORT marks the public symbols of the shared library; all other symbols are hidden.
 * Its users define CURVEWISE_SHARED; the CMake target and the pkg-config file do so for them. In a
 * static library nothing is marked: a library that embeds it does not export these symbols. C and
 * C++. */
#ifndef CURVEWISE_EXPORT_H
#define CURVEWISE_EXPORT_H

#if !defined(CURVEWISE_SHARED)
#define CURVEWISE_EXPORT
#elif defined(_WIN32) && defined(CURVEWISE_BUILDING)
#define CURVEWISE_EXPORT __declspec(dllexport)
#elif defined(_WIN32)
#define CURVEWISE_EXPORT __declspec(dllimport)
#else
#define CURVEWISE_EXPORT __attribute__((visibility("default")))
#endif

#endif
