#pragma once

#include <gtest/gtest.h>

#include "test_colon.h"
#include "vicon/support/support.h"
#include "vicon/viewer/scene/display.h"
#include "vicon/viewer/scene/prepared_scan.h"

namespace vicon::viewer::test {

/// A display, and the test colon as a scan's folder.
struct ScanFixture : testing::Test {
    Display display;
    support::TemporaryFolder folder;
    TestColon colon;

    PreparedScan scan(const TestColon& from, const std::string& name = "scan") const
    {
        from.write(folder / name);
        return PreparedScan::open(folder / name);
    }
    PreparedScan scan() const { return scan(colon); }
};

}  // namespace vicon::viewer::test
