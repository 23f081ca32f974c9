#pragma once

#include <gtest/gtest.h>
#include <soci/soci.h>

#include <algorithm>

#include "vicon/cases/case_store.h"
#include "vicon/core/file.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/load_scan.h"
#include "vicon/support/support.h"

namespace vicon::test {

/// A store of its own for a test, and shortcuts into it.
class StoreFixture : public ::testing::Test {
protected:
    support::TemporaryFolder folder;
    CaseStore store{folder / "store"};
    ingest::ImportOptions options;
    NoProgress quiet;

    ingest::ImportReport import(const std::vector<std::filesystem::path>& paths)
    {
        return ingest::importPaths(store, paths, options, quiet);
    }
    ScanRecord onlyScan()
    {
        const auto cases = store.cases();
        EXPECT_EQ(cases.size(), 1u);
        const auto scans = store.scans(cases.at(0).id);
        EXPECT_EQ(scans.size(), 1u);
        return scans.at(0);
    }
    HuVolume load(const ScanRecord& scan)
    {
        return ingest::loadScan(store.scanFolder(scan.case_id, scan.id) / "dicom", options, quiet);
    }
    int jobs()
    {
        int count = 0;
        store.database().session() << "SELECT COUNT(*) FROM jobs WHERE state = 'queued'", soci::into(count);
        return count;
    }
    /// Whether a line of this kind holds these words.
    static bool says(const ingest::ImportReport& report, ingest::ImportLine::Kind kind, const std::string& words)
    {
        return std::any_of(report.lines.begin(), report.lines.end(), [&](const ingest::ImportLine& line) {
            return line.kind == kind && line.text.find(words) != std::string::npos;
        });
    }
    /// All lines, for the message of a failing test.
    static std::string lines(const ingest::ImportReport& report)
    {
        std::string text;
        for (const auto& line : report.lines)
            text += nameOf(line.kind) + " " + line.subject + ": " + line.text + "\n";
        return text;
    }
};

}  // namespace vicon::test
