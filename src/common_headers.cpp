// Empty: CMake needs a source file for which the header is precompiled.
