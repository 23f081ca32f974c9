// What happens where a report cannot be written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "pdf_fixture.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::report {
namespace {

using testing::HasSubstr;
using testing::Not;

class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes)
    {
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit()
    {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    rlimit before_{};
    void (*handler_)(int) = nullptr;
};

using PdfFailure = PdfWriter;

TEST_F(PdfFailure, AFullDiskIsOneErrorAndLeavesTheOldReport)
{
    const fs::path target = folder_ / "reports" / "1.pdf";
    fs::create_directory(target.parent_path());
    replaceFile(target, "the old report");
    try {
        const FileSizeLimit full(1000);
        writePdf(content_, target, {});
        FAIL() << "wrote a report to a full disk";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::store);
        EXPECT_THAT(std::string(e.what()) + e.subject() + e.remedy(), Not(HasSubstr("Adams")));
    }
    EXPECT_EQ(readFile(target), "the old report");
    EXPECT_EQ(std::distance(fs::directory_iterator(target.parent_path()), fs::directory_iterator()), 1);
}

TEST_F(PdfFailure, AnUnwritableTargetIsOneError)
{
    replaceFile(folder_ / "file", "no folder");
    for (const fs::path& target : {folder_ / "nowhere" / "1.pdf", folder_ / "file" / "1.pdf"})
        try {
            writePdf(content_, target, {});
            ADD_FAILURE() << target;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::store);
        }
}

TEST_F(PdfFailure, WithoutFontsItSaysWhatToInstall)
{
    try {
        write({.font_folder = (folder_ / "no fonts").string()});
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::not_found);
        EXPECT_THAT(e.remedy(), HasSubstr("fonts-noto-core"));
    }
    EXPECT_FALSE(fs::exists(pdf_));
}

/// Is wanted until it was asked so often.
class WantedForAWhile : public NoProgress {
public:
    explicit WantedForAWhile(int times) : left_(times) {}
    bool cancelled() const override { return left_-- <= 0; }

private:
    mutable int left_;
};

TEST_F(PdfFailure, AtEveryPageItCanBeGivenUp)
{
    addMarkers(12);
    std::string pdf;
    const int pages = drawPdf(content_, pdf, {}, nullptr, NoProgress()).pages;
    ASSERT_GT(pages, 3);
    const int asked = pages + 1;  // before the file is put together, too
    pdf = "the old report";
    for (int times = 0; times < asked; ++times)
        try {
            drawPdf(content_, pdf, {}, nullptr, WantedForAWhile(times));
            ADD_FAILURE() << times;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::cancelled);
            EXPECT_EQ(pdf, "the old report");
        }
    EXPECT_EQ(drawPdf(content_, pdf, {}, nullptr, WantedForAWhile(asked)).pages, pages);
}

}  // namespace
}  // namespace vicon::report
