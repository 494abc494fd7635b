/* CURVEWISE_EXPORT marks what the shared library shows; everything else in it is hidden. Its users
 * define CURVEWISE_SHARED, which the CMake target and the pkg-config file do for them. In a static
 * library nothing is marked: a library that embeds it does not show it to others. C and C++. */
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
