#include "tests/statistics/report.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>

#include "tests/statistics/seed.h"

namespace arcus::statistics {

namespace {

int next_number(const std::string& test) {
  static std::mutex mutex;
  static std::map<std::string, int> reports;
  const std::lock_guard lock(mutex);
  return ++reports[test];
}

}  // namespace

std::string write_report(const std::string& csv) {
  namespace fs = std::filesystem;
  std::string name = test_name();
  const int number = next_number(name);
  for (char& c : name)
    if (c == '/') c = '_';  // of parametrised tests
  const fs::path path =
      fs::path(STATISTICS_REPORT_FOLDER) / (name + "." + std::to_string(number) + ".csv");
  std::error_code ignored;
  fs::create_directories(path.parent_path(), ignored);
  std::ofstream file(path);
  file << csv;
  file.close();
  return file ? path.string() : path.string() + " (which could not be written)";
}

}  // namespace arcus::statistics
