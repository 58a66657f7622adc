// Nothing: CMake wants a file to precompile a header for.
