// A report as one HTML page: sections of paragraphs, tables and pictures. The style is in the page, pictures
// are files beside it, there are no scripts, and nothing is fetched from elsewhere.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace palpate::sim {

/// What a cell of a table says beyond its text. The page explains the marks it uses.
enum class Mark {
  kPlain,
  kPaper,    // the paper's value
  kOurs,     // ours, to be compared with it
  kHolds,    // within what is required
  kFails,    // not within what is required
  kGoalMet,  // a goal is measured and reported, never required
  kGoalMissed,
};

struct Cell {
  std::string text;
  Mark mark = Mark::kPlain;
};

struct Table {
  std::string caption;  // may be empty
  std::vector<std::string> header;
  std::vector<std::vector<Cell>> rows;  // as long as the header
};

struct Figure {
  std::string file;     // as seen from the page
  std::string caption;  // also for those who cannot see it
};

class ReportPage {
 public:
  /// `summary`: a sentence or two below the title; may be empty.
  ReportPage(const std::string& title, const std::string& summary);
  ReportPage(const ReportPage&) = delete;
  ReportPage(ReportPage&&) = delete;
  ReportPage& operator=(const ReportPage&) = delete;
  ReportPage& operator=(ReportPage&&) = delete;
  ~ReportPage();

  /// Everything that follows belongs to it. The page lists its sections on top.
  void add_section(const std::string& title);
  void add_paragraph(const std::string& text);
  /// Columns of numbers are aligned to the right. Throws std::invalid_argument for a row of another length
  /// than the header.
  void add_table(const Table& table);
  /// Side by side as far as the page is wide.
  void add_figures(const std::vector<Figure>& figures);

  [[nodiscard]] std::string html() const;
  /// The file appears complete or not at all. Throws EnvironmentError when it cannot be written.
  void write(const std::filesystem::path& path) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace palpate::sim
