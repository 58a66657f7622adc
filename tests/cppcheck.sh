#!/bin/sh
# cppcheck PROGRAM, on one file per folder that includes those of the folder: headers are read once per folder. With the macros
# that conditions ask for given, as the compiler has them, everything is checked once and not in each combination of them.
set -e
groups=$(mktemp -d)
trap 'rm -rf "$groups"' EXIT
for folder in $(find src apps/eigentrail -name '*.cpp' -printf '%h\n' | sort -u); do
  for file in "$folder"/*.cpp; do
    echo "#include \"$PWD/$file\""
  done >"$groups/$(echo "$folder" | tr / _).cpp"
done
"$1" --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr --quiet \
  --suppressions-list=.cppcheck -D__SIZEOF_FLOAT128__=16 -D__GLIBC__=2 "-DEIGEN_VERSION_AT_LEAST(x,y,z)=0" -I src -I include --error-exitcode=1 "$groups"
