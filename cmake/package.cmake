# The Debian package, made by cpack or ./bootstrap package. It contains what `cmake --install` installs, under
# /usr; the Python package goes to the folder in which Debian's interpreter searches.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME eigentrail)
set(CPACK_PACKAGE_VENDOR "the eigentrail developers")
set(CPACK_PACKAGE_CONTACT "eigentrail maintainers <maintainers@users.noreply.h-seed-ff760a79.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "follows eigenvalues of constrained mechanical systems")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
  "eigentrail follows the eigenvalues of a constrained mechanical system while one of its
parameters changes: rotor flap and lag frequencies against rotor speed, whirl of a
shaft, a column under load, or any matrices M(p), C(p), K(p). A scene file goes in;
labelled loci of known accuracy come out.
.
The package has the program, the C++ library with its headers and CMake configuration,
and the Python package, which computes, reads its files, and draws the pictures of
`eigentrail plot`.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_STRIP_FILES ON)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
# Depends on the libraries to which the program is linked, with their versions. The Python package and the
# static library need further packages, which are only recommended or suggested because not every user needs
# them.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
  "python3, python3-h5py, python3-matplotlib, python3-numpy, python3-pandas, python3-plotly, python3-scipy, python3-tqdm, python3-xarray")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "cmake, g++, libeigen3-dev, libhdf5-dev, liblapacke-dev, libopenblas-dev, libsuitesparse-dev, libsundials-dev, libtomlplusplus-dev, libzip-dev, zlib1g-dev")

find_program(GZIP gzip)
if(GZIP)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  configure_file(cmake/debian/changelog.in ${PROJECT_BINARY_DIR}/debian/changelog @ONLY)
  execute_process(COMMAND ${GZIP} -9nf ${PROJECT_BINARY_DIR}/debian/changelog COMMAND_ERROR_IS_FATAL ANY)
  install(FILES cmake/debian/copyright ${PROJECT_BINARY_DIR}/debian/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT debian EXCLUDE_FROM_ALL)
endif()

set(CPACK_INSTALL_CMAKE_PROJECTS
  "${PROJECT_BINARY_DIR};eigentrail;Unspecified;/" "${PROJECT_BINARY_DIR};eigentrail;debian;/")
include(CPack)
