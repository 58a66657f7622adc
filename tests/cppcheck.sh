#!/bin/sh
# cppcheck PROGRAM, on one file per folder that includes those of the folder: headers are read once per folder.
set -e
groups=$(mktemp -d)
trap 'rm -rf "$groups"' EXIT
for folder in $(find src apps/eigentrail -name '*.cpp' -printf '%h\n' | sort -u); do
  for file in "$folder"/*.cpp; do
    echo "#include \"$PWD/$file\""
  done >"$groups/$(echo "$folder" | tr / _).cpp"
done
"$1" --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr --quiet \
  --suppressions-list=.cppcheck -I src -I include --error-exitcode=1 "$groups"
