// Reads the rows of a CSV file by the names of their columns. The readers of
// base/files/csv_files.cpp and similar files are built on it.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>

#include "base/files/csv_files.h"

// Tells the library to read without a second thread.
#define CSV_IO_NO_THREAD
#include <libfccp/csv.h>

namespace ols::csv {

// The column names of a file, required ones first.
template <std::size_t kColumns>
struct Header {
  std::array<const char*, kColumns> names;
  std::size_t required;
};

// One row: its cells by column, and the path and line for error messages. A cell is null if the
// file has no such column.
template <std::size_t kColumns>
class Row {
 public:
  Row(const std::string& path, unsigned line, const Header<kColumns>& header,
      const std::array<const char*, kColumns>& cells)
      : path_(path), line_(line), header_(header), cells_(cells) {}

  [[noreturn]] void fail(std::size_t column, const std::string& what) const {
    throw CsvError(path_ + ":" + std::to_string(line_) + ": " + header_.names[column] + ": " +
                   what);
  }
  unsigned line() const { return line_; }
  bool has_column(std::size_t column) const { return cells_[column] != nullptr; }
  bool has(std::size_t column) const {
    return cells_[column] != nullptr && *cells_[column] != '\0';
  }
  std::string text(std::size_t column) const {
    if (!has(column)) fail(column, "is empty");
    return cells_[column];
  }
  // An id has no comma, quote or control character, because it is copied to other files unchanged.
  std::string id(std::size_t column) const {
    const std::string cell = text(column);
    const bool plain = std::ranges::none_of(
        cell, [](unsigned char c) { return c == ',' || c == '"' || c < 0x20 || c == 0x7f; });
    if (!plain) fail(column, "has a comma, a quote or a control character");
    return cell;
  }
  template <class Number>
  Number number(std::size_t column, Number least, Number greatest) const {
    const std::string cell = text(column);
    const char* end = cell.data() + cell.size();
    Number value{};
    const auto [rest, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc() || rest != end) fail(column, "'" + cell + "' is not a number");
    if (!(value >= least && value <= greatest)) {
      std::ostringstream range;
      range << cell << " is outside " << least << " .. " << greatest;
      fail(column, range.str());
    }
    return value;
  }
  std::optional<double> optional_number(std::size_t column, double least, double greatest) const {
    if (!has(column)) return std::nullopt;
    return number<double>(column, least, greatest);
  }

 private:
  const std::string& path_;
  unsigned line_;
  const Header<kColumns>& header_;
  const std::array<const char*, kColumns>& cells_;
};

template <std::size_t kColumns>
using Reader = io::CSVReader<kColumns, io::trim_chars<' ', '\t'>, io::double_quote_escape<',', '"'>,
                             io::throw_on_overflow, io::empty_line_comment>;

// The separator that a spreadsheet has written instead of the comma: "semicolons" or "tabs"; empty:
// neither.
inline std::string other_separator(const std::string& path) {
  std::string header;
  std::getline(std::ifstream(path, std::ios::binary), header);
  if (header.find(',') != std::string::npos) return "";
  if (header.find(';') != std::string::npos) return "semicolons";
  return header.find('\t') != std::string::npos ? "tabs" : "";
}

template <std::size_t kColumns>
void read_header(Reader<kColumns>& reader, const std::string& path,
                 const Header<kColumns>& header) {
  std::apply(
      [&](auto... names) {
        reader.read_header(io::ignore_extra_column | io::ignore_missing_column, names...);
      },
      header.names);
  for (std::size_t i = 0; i < header.required; ++i) {
    if (reader.has_column(header.names[i])) continue;
    const std::string separator = other_separator(path);
    if (!separator.empty()) {
      throw CsvError(path + ":1: header: columns are separated by " + separator +
                     ", commas are needed");
    }
    throw CsvError(path + ":1: " + header.names[i] + ": the column is missing");
  }
}

// The bytes of a file, with a line end added if the last line has none: without a line end the
// library would read past the end of the file. Zero bytes, which a loss of power can leave in
// blocks, are an error. The library would take each for the end of a row, and silently skip the
// empty rows.
class EndedLines : public io::ByteSourceBase {
 public:
  explicit EndedLines(const std::string& path) : path_(path), file_(path, std::ios::binary) {
    file_.peek();  // opening a folder succeeds; reading fails here
    if (!file_.is_open() || file_.bad()) throw CsvError(path + ": cannot be read");
    file_.clear();
  }
  int read(char* buffer, int size) override {
    file_.read(buffer, size);
    if (file_.bad()) throw CsvError(path_ + ": cannot be read");
    auto count = static_cast<int>(file_.gcount());
    check_text({buffer, static_cast<std::size_t>(count)});
    if (count > 0) last_ = buffer[count - 1];
    // The line end is added together with the file's last bytes, not later, because the library
    // reads only once if the file fits into the buffer.
    if (count < size && last_ != '\n') buffer[count++] = last_ = '\n';
    return count;
  }

 private:
  void check_text(std::string_view bytes) {
    const std::string_view text = bytes.substr(0, bytes.find('\0'));
    line_ += std::ranges::count(text, '\n');
    if (text.size() == bytes.size()) return;
    throw CsvError(path_ + ":" + std::to_string(line_) +
                   ": row: has a zero byte: the file is damaged, or no CSV in UTF-8");
  }

  std::string path_;
  std::ifstream file_;
  std::ptrdiff_t line_ = 1;
  char last_ = '\n';
};

// Passes each row to `take`; translates the library's errors.
template <std::size_t kColumns, class Take>
void for_each_row(const std::string& path, const Header<kColumns>& header, Take take) {
  try {
    Reader<kColumns> reader(path, std::make_unique<EndedLines>(path));
    read_header<kColumns>(reader, path, header);
    std::array<const char*, kColumns> cells{};
    const auto next = [&](auto&... cell) { return reader.read_row(cell...); };
    while (std::apply(next, cells)) {
      take(Row<kColumns>(path, reader.get_file_line(), header, cells));
    }
  } catch (const io::error::header_missing&) {
    throw CsvError(path + ":1: header: is missing");
  } catch (const io::error::with_file_line& error) {
    throw CsvError(path + ":" + std::to_string(error.file_line) +
                   ": row: too few or too many columns, or a quote that stays open");
  } catch (const io::error::base& error) {
    throw CsvError(path + ":1: header: " + error.what());
  }
}

// Reads a place: latitude and longitude from two columns, of which `geodetic` is the first; or
// zone, easting and northing from three columns, of which `utm` is the first. A zone is written as
// "33N": its number and the hemisphere, not the letter of a latitude band.
template <std::size_t kColumns>
std::variant<GeodeticCells, UtmCells> place_of(const Row<kColumns>& row, std::size_t geodetic,
                                               std::size_t utm) {
  const bool is_utm = row.has(utm) || row.has(utm + 1) || row.has(utm + 2);
  if (!is_utm) {
    return GeodeticCells{row.template number<double>(geodetic, -90.0, 90.0),
                         row.template number<double>(geodetic + 1, -180.0, 360.0)};
  }
  if (row.has(geodetic) || row.has(geodetic + 1)) {
    row.fail(utm, "must be empty: latitude and longitude are given");
  }
  UtmCells cells;
  const std::string zone = row.text(utm);
  const auto [rest, error] = std::from_chars(zone.data(), zone.data() + zone.size(), cells.zone);
  const std::string hemisphere(rest, zone.data() + zone.size());
  if (error != std::errc() || cells.zone < 1 || cells.zone > 60 ||
      (hemisphere != "N" && hemisphere != "S")) {
    row.fail(utm, "'" + zone + "' is not a zone 1 .. 60 and its hemisphere N or S, as 33N");
  }
  cells.northern = hemisphere == "N";
  cells.easting_m = row.template number<double>(utm + 1, 0.0, 1e6);
  cells.northing_m = row.template number<double>(utm + 2, 0.0, 1e7);
  return cells;
}

}  // namespace ols::csv
