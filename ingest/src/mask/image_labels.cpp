#include "mask/image_labels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "mask/refusal.h"
#include "mask/voxel_stream.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// Zlib packs no better.
constexpr double kBestPacking = 1032;
constexpr double kLargestLabel = 65535;

/// Before memory is asked for: whether the file can hold what its header says.
void requireLength(const ImageHeader& header)
{
    const double needed = double(header.grid.voxelCount()) * double(bytesOf(header.type)) + double(header.skip);
    const double there = double(fs::file_size(header.voxel_file)) - double(header.begin);
    if (header.packed ? there * kBestPacking < needed : there < needed)
        throw maskRefused(header.voxel_file, "is cut off: it holds fewer voxels than its header says",
                          "write the mask again, or copy it again");
}

template <class Stored>
double numberAt(const char* bytes, bool swapped)
{
    std::array<char, sizeof(Stored)> own{};
    std::memcpy(own.data(), bytes, own.size());
    if (swapped)
        std::reverse(own.begin(), own.end());
    return double(std::bit_cast<Stored>(own));
}

double (*readerOf(VoxelType type))(const char*, bool)
{
    switch (type) {
        case VoxelType::u8:
            return numberAt<std::uint8_t>;
        case VoxelType::i8:
            return numberAt<std::int8_t>;
        case VoxelType::u16:
            return numberAt<std::uint16_t>;
        case VoxelType::i16:
            return numberAt<std::int16_t>;
        case VoxelType::u32:
            return numberAt<std::uint32_t>;
        case VoxelType::i32:
            return numberAt<std::int32_t>;
        case VoxelType::u64:
            return numberAt<std::uint64_t>;
        case VoxelType::i64:
            return numberAt<std::int64_t>;
        case VoxelType::f32:
            return numberAt<float>;
        default:
            return numberAt<double>;
    }
}

/// The labels of one row of voxels.
class RowReader {
public:
    explicit RowReader(const ImageHeader& header)
        : header_(header),
          stream_(header.voxel_file, header.begin, header.packed),
          bytes_(std::size_t(header.grid.size[0]) * bytesOf(header.type)),
          read_(readerOf(header.type))
    {
        stream_.skip(header.skip);
    }
    void read(int j, int k, LabelledSlices& labels)
    {
        stream_.read(bytes_.data(), bytes_.size());
        if (header_.intercept == 0 && std::all_of(bytes_.begin(), bytes_.end(), [](char byte) { return byte == 0; }))
            return;
        const bool swapped = header_.big_endian == (std::endian::native == std::endian::little);
        for (int i = 0; i < header_.grid.size[0]; ++i) {
            const double stored = read_(&bytes_[std::size_t(i) * bytesOf(header_.type)], swapped);
            const double value = stored * header_.slope + header_.intercept;
            if (value != 0)
                put({i, j, k}, value, labels);
        }
    }
    void requireEnd() { stream_.requireEnd(); }

private:
    void put(Index3 voxel, double value, LabelledSlices& labels) const
    {
        if (!(value >= 0 && value <= kLargestLabel) || value != std::floor(value))
            throw maskRefused(header_.voxel_file, "holds numbers that are no labels: fractions, or below zero",
                              "write labels, 0 outside and whole numbers inside");
        if (!labels.set(voxel, std::int64_t(value)))
            throw maskRefused(header_.voxel_file, "holds more than 250 different values: an image, no mask",
                              "write labels, 0 outside and whole numbers inside");
    }

    const ImageHeader& header_;
    VoxelStream stream_;
    std::vector<char> bytes_;
    double (*read_)(const char*, bool);
};

}  // namespace

LabelledSlices readImageLabels(const ImageHeader& header, Progress& progress)
{
    requireLength(header);
    LabelledSlices labels(header.grid);
    RowReader rows(header);
    for (int k = 0; k < header.grid.size[2]; ++k) {
        progress.check();
        progress.report(double(k) / header.grid.size[2], "reading the mask");
        for (int j = 0; j < header.grid.size[1]; ++j)
            rows.read(j, k, labels);
    }
    rows.requireEnd();
    return labels;
}

}  // namespace vicon::ingest
