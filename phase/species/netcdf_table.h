#pragma once
// The NetCDF-4 files that this library keeps its own tables in: written whole or not at all, with a seal over all bytes, and read
// with every length checked. What is in them is said by species_file.cpp and oriented_file.cpp.

#include <memory>
#include <string>
#include <vector>

namespace arcus::phase {

struct TableVariable {
  const char *name, *units, *long_name;
};

class NetcdfTableWriter {
 public:
  /// Throws cannot() where the file cannot be written; so do all others.
  explicit NetcdfTableWriter(const std::string& path);
  ~NetcdfTableWriter();

  void text(const char* attribute, const std::string& value);
  void number(const char* attribute, double value);
  void integer(const char* attribute, int value);
  /// A dimension and the variable of its name.
  void axis(const TableVariable& variable, const std::vector<double>& values);
  /// dimensions: places of axes in the order in which they were written; the last runs fastest.
  void variable(const TableVariable& variable, const std::vector<double>& values, const std::vector<int>& dimensions);
  void variable(const TableVariable& variable, const std::vector<float>& values, const std::vector<int>& dimensions);
  /// The same, compressed without loss in pieces of whole rows of all dimensions but the first two.
  void compressed(const TableVariable& variable, const std::vector<float>& values, const std::vector<int>& dimensions);
  /// Closes, seals and names the file. Without it nothing is left.
  void commit();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// The attribute arcus_format of a sealed file; 0 where it has none. Throws bad_input where the file is missing or not sealed.
int netcdf_table_format(const std::string& path);

class NetcdfTableReader {
 public:
  /// what: such as "phase table", for messages. Throws bad_input where the file is missing, not sealed, or of another format (the
  /// attribute arcus_format); the others where something is not as expected.
  NetcdfTableReader(const std::string& path, const std::string& what, int format);
  ~NetcdfTableReader();

  std::string text(const char* attribute);
  double number(const char* attribute);
  /// Axes are to be read in the order in which they were written.
  void axis(const TableVariable& variable, std::vector<double>& values, std::size_t most);
  void variable(const TableVariable& variable, std::vector<double>& values, const std::vector<int>& dimensions);
  void variable(const TableVariable& variable, std::vector<float>& values, const std::vector<int>& dimensions);

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace arcus::phase
