#pragma once

#include <gtest/gtest.h>

#include "test_colon.h"
#include "vicon/support/support.h"
#include "vicon/viewer/scene/display.h"
#include "vicon/viewer/scene/prepared_scan.h"

namespace vicon::viewer::test {

/// A display, and test colons as scans' folders.
struct ScanFixture : testing::Test {
    Display display;
    support::TemporaryFolder folder;

    PreparedScan scan(const TestColon& from, const std::string& name = "scan") const
    {
        from.write(folder / name);
        return PreparedScan::open(folder / name);
    }
};

/// ... stored head first, supine.
struct ColonFixture : ScanFixture {
    TestColon colon;

    using ScanFixture::scan;
    PreparedScan scan() const { return scan(colon); }
};

}  // namespace vicon::viewer::test
