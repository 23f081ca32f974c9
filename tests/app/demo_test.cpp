// The synthetic case of `vicon read --demo`.
#include <gtest/gtest.h>

#include "demo_case.h"
#include "vicon/cases/worklist.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

phantom::PhantomOptions smallPhantom()
{
    phantom::PhantomOptions options;
    options.size = {160, 160, 134};
    options.prone = options.folds = false;
    options.gaps = 0;
    options.seed = 3;
    return options;
}

/// As the command has it, with a reader's store that is used elsewhere.
std::string openDemo(const fs::path& reader_store, const phantom::PhantomOptions& options = smallPhantom())
{
    app::Context context;
    context.store_folder = reader_store.string();
    context.assignments = {"store.database=host=127.0.0.1 port=1 dbname=none"};  // whoever asks it learns that
    context.useStoreOfItsOwn(reader_store.string() + "-demo");
    return app::demoCase(context, options);
}

TEST(DemoCase, IsMadeOnceInAStoreOfItsOwnAndCanBeRead)
{
    const TemporaryFolder folder;
    const fs::path reader_store = folder / "store";
    const std::string id = openDemo(reader_store);
    EXPECT_FALSE(fs::exists(reader_store)) << "the reader's own store is left be";
    const fs::path store_folder = folder / "store-demo";
    CaseStore store(store_folder);
    ASSERT_EQ(store.cases().size(), 1U);
    const WorklistCase row = makeWorklistCase(store, QueueOptions(), store.requireCase(id));
    EXPECT_EQ(row.state, WorkState::done);
    ASSERT_EQ(row.scans.size(), 1U);
    EXPECT_TRUE(row.scans.front().ready());
    for (const auto& entry : fs::directory_iterator(store_folder))
        EXPECT_FALSE(entry.path().filename().string().starts_with("demo-")) << "its images are imported";
    const auto made = fs::last_write_time(row.scans.front().folder / "cells.vtp");
    EXPECT_EQ(openDemo(reader_store), id);
    EXPECT_EQ(fs::last_write_time(row.scans.front().folder / "cells.vtp"), made) << "the second time it is there";
}

}  // namespace
}  // namespace vicon::support
