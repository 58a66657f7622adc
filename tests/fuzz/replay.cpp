// Runs every file of a corpus through its trial, without a fuzzer: replay scene corpus/scene.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "fuzz/entry.hpp"

int main(int argc, char** argv) {
  if (argc != 3 || !eigentrail::fuzz::trials().contains(argv[1])) return 2;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(argv[2])) {
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    // The last line printed before a crash names the file.
    std::printf("%s\n", entry.path().filename().c_str());
    std::fflush(stdout);
    eigentrail::fuzz::trials()[argv[1]](bytes);
    ++files;
  }
  std::printf("%d files\n", files);
  return files > 0 ? 0 : 1;
}
