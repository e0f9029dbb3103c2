#pragma once
// The report inside results.h5, from which it can be drawn again, and the files that are drawn.
//
// /report: attribute schema_version; dataset `structure`, one JSON text (reports/report_json.h) in which an
// array of numbers is the name of a dataset in /report/arrays.

#include <filesystem>
#include <string>
#include <vector>

#include "harness/io/hdf5.h"
#include "reports/report.h"

namespace ddem::harness {

/// Writes /report into the file of `root`.
void store_report(Hdf5Group& root, const reports::Report& report);

/// The report of FOLDER/results.h5. Throws InputError, which says what to do, where there is none, an older
/// program wrote it, or it is damaged.
reports::Report load_report(const std::filesystem::path& folder);

/// Of which campaign a report is, whatever its numbers: a digest of its title, summary and cases.
std::string campaign_mark(const reports::Report& report);
/// The mark of FOLDER/report.html; empty where it has none.
std::string drawn_campaign(const std::filesystem::path& folder);

/// A file of a report, by its path inside the folder.
struct ReportFile {
  std::filesystem::path name;
  std::string content;
};

/// The page alone.
std::string draw_page(const reports::Report& report);

/// report.html, and each figure as figures/ID.svg and figures/ID.csv.
std::vector<ReportFile> draw_report(const reports::Report& report);

/// Each file is replaced whole or not at all. Throws MachineError.
void write_report_files(const std::filesystem::path& folder, const std::vector<ReportFile>& files);

}  // namespace ddem::harness
