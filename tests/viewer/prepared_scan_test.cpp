#include "vicon/viewer/scene/prepared_scan.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "scan_fixture.h"

namespace vicon::viewer {
namespace {

struct PreparedScans : test::ColonFixture {};

/// How often the calling thread has met a page that it could not see yet.
long pageFaults()
{
    rusage usage{};
    ::getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_minflt + usage.ru_majflt;
}

double sumOverLumen(const FieldView& field, const InsideView& inside)
{
    double sum = 0;
    for (std::size_t n = 0; n < inside.voxels.size(); ++n)
        if (inside.voxels[n] != kOutside)
            sum += field.voxels[n];
    return sum;
}

// The camera flies on the window's thread, which must not wait for a disk.
TEST_F(PreparedScans, ThatAreReadForAFlightHaveTheFieldsOfTheLumenInMemory)
{
    const PreparedScan prepared = scan();
    prepared.readForFlight();
    prepared.readOn(NoProgress());
    const InsideView inside = prepared.inside();
    const FieldView wall = prepared.wallDistance(), exit = prepared.exitDistance();
    sumOverLumen(FieldView(inside.grid, std::vector<float>(inside.voxels.size())), inside);  // the code and the labels
    const long before = pageFaults();
    const double sum = sumOverLumen(wall, inside) + sumOverLumen(exit, inside);
    EXPECT_EQ(pageFaults(), before);
    EXPECT_GT(sum, 0);
}

/// Puts a file out of the memory that the system keeps of it.
void evict(const std::filesystem::path& file)
{
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    ::fsync(descriptor);
    ::posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED);
    ::close(descriptor);
}

/// The share of a file's pages that are in memory.
double residentShare(const std::filesystem::path& file)
{
    const std::size_t size = std::filesystem::file_size(file), page = std::size_t(::sysconf(_SC_PAGESIZE));
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    void* bytes = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
    std::vector<unsigned char> pages((size + page - 1) / page);
    EXPECT_EQ(::mincore(bytes, size, pages.data()), 0);
    ::munmap(bytes, size);
    ::close(descriptor);
    return double(std::count_if(pages.begin(), pages.end(), [](unsigned char in) { return (in & 1) != 0; })) /
           double(pages.size());
}

TEST_F(PreparedScans, ReadBeforeTheFirstPictureNeitherTheDensitiesNorTheDistancesFromTheExit)
{
    test::TestColon fine(test::storages().front(), 1.4);
    const PreparedScan prepared = scan(fine);
    const auto share = [&](const char* name) { return residentShare(prepared.folder() / name); };
    for (const char* name : {"volume.mha", "exit_distance.mha", "wall_distance.mha"})
        evict(prepared.folder() / name);
    if (share("volume.mha") > 0.1)
        GTEST_SKIP() << "the temporary folder lies in memory";
    prepared.readForFlight();
    EXPECT_LT(share("volume.mha"), 0.3);
    EXPECT_LT(share("exit_distance.mha"), 0.3);
    EXPECT_GT(share("wall_distance.mha"), 0.5) << "a camera asks for it";
    prepared.readOn(NoProgress());
    EXPECT_GT(share("exit_distance.mha"), 0.5);
}

}  // namespace
}  // namespace vicon::viewer
