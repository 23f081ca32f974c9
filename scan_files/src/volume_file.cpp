#include "vicon/scan_files/volume_file.h"

#include <itkMetaImageIO.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <span>

#include "mapped_file.h"
#include "meta_header.h"
#include "streamed_file.h"
#include "unpack.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/fresh_memory.h"
#include "vicon/scan_files/itk_globals.h"
#include "vicon/scan_files/stored_volume.h"

namespace fs = std::filesystem;

namespace vicon::scan_files {
namespace {

template <class T>
constexpr itk::IOComponentEnum kComponent = itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE;
template <>
constexpr itk::IOComponentEnum kComponent<std::int16_t> = itk::IOComponentEnum::SHORT;
template <>
constexpr itk::IOComponentEnum kComponent<std::uint8_t> = itk::IOComponentEnum::UCHAR;
template <>
constexpr itk::IOComponentEnum kComponent<std::uint16_t> = itk::IOComponentEnum::USHORT;
template <>
constexpr itk::IOComponentEnum kComponent<float> = itk::IOComponentEnum::FLOAT;

constexpr int kZlibLevel = 1;  // labels: level 1 is four times as fast as 6 for files a fifth larger

itk::MetaImageIO::Pointer newImageIO()
{
    makeItkGlobals();
    return itk::MetaImageIO::New();
}

itk::MetaImageIO::Pointer openHeader(const fs::path& file)
{
    if (!fs::exists(file))
        throw Error(ErrorCode::not_found, "no such file", file.string(), "run 'vicon work' to make it");
    if (!isPlainHeader(file))
        throw Error(ErrorCode::bad_input, "not a MetaImage file of three dimensions with its voxels", file.string(),
                    "run 'vicon work' to make it anew");
    auto io = newImageIO();
    try {
        io->SetFileName(file.string());
        io->ReadImageInformation();
    } catch (const itk::ExceptionObject&) {
        throw Error(ErrorCode::bad_input, "not a MetaImage file", file.string(), "run 'vicon work' to make it anew");
    }
    if (io->GetNumberOfDimensions() != 3 || io->GetNumberOfComponents() != 1)
        throw Error(ErrorCode::bad_input, "not a scalar volume", file.string());
    return io;
}

/// No scan has more voxels along an axis.
constexpr itk::SizeValueType kLongestAxis = 65535;

/// Whether a header's numbers can be a grid: voxels of some size, at places that are numbers.
bool describesGrid(itk::MetaImageIO& io)
{
    for (unsigned a = 0; a < 3; ++a) {
        const auto direction = io.GetDirection(a);
        if (io.GetDimensions(a) < 1 || io.GetDimensions(a) > kLongestAxis || !std::isfinite(io.GetSpacing(a)) ||
            io.GetSpacing(a) <= 0 || !std::isfinite(io.GetOrigin(a)) ||
            !std::all_of(direction.begin(), direction.end(), [](double d) { return std::isfinite(d); }))
            return false;
    }
    return true;
}

Grid gridOf(itk::MetaImageIO& io, const fs::path& file)
{
    if (!describesGrid(io))
        throw Error(ErrorCode::bad_input, "has a header that describes no volume", file.string());
    Grid grid;
    grid.origin_mm = {io.GetOrigin(0), io.GetOrigin(1), io.GetOrigin(2)};
    for (unsigned a = 0; a < 3; ++a) {
        grid.size[a] = int(io.GetDimensions(a));
        grid.spacing_mm[a] = io.GetSpacing(a);
        const auto d = io.GetDirection(a);
        grid.axis[a] = {d[0], d[1], d[2]};
    }
    return grid;
}

template <class T>
constexpr const char* kTypeName = "";
template <>
constexpr const char* kTypeName<std::int16_t> = "MET_SHORT";
template <>
constexpr const char* kTypeName<std::uint8_t> = "MET_UCHAR";
template <>
constexpr const char* kTypeName<std::uint16_t> = "MET_USHORT";
template <>
constexpr const char* kTypeName<float> = "MET_FLOAT";

// By hand, not by ITK: voxels that ITK writes begin anywhere, and could not be mapped.
template <class T>
void writeRaw(const fs::path& temporary, const fs::path& file, const Volume<T>& volume)
{
    const std::string header = rawHeader(volume.grid, kTypeName<T>);
    StreamedFile out(temporary, file);
    out.write(header.data(), header.size());
    out.write(volume.voxels.data(), volume.voxels.size() * sizeof(T));
    out.finish();
}

template <class T>
void writePacked(const fs::path& file, const Volume<T>& volume)
{
    auto io = newImageIO();
    io->SetNumberOfDimensions(3);
    io->SetNumberOfComponents(1);
    io->SetPixelType(itk::IOPixelEnum::SCALAR);
    io->SetComponentType(kComponent<T>);
    io->SetFileType(itk::IOFileEnum::Binary);
    const Grid& g = volume.grid;
    const std::array<double, 3> origin{g.origin_mm.x, g.origin_mm.y, g.origin_mm.z};
    itk::ImageIORegion region(3);
    for (unsigned a = 0; a < 3; ++a) {
        io->SetDimensions(a, std::size_t(g.size[a]));
        io->SetSpacing(a, g.spacing_mm[a]);
        io->SetOrigin(a, origin[a]);
        io->SetDirection(a, std::vector<double>{g.axis[a].x, g.axis[a].y, g.axis[a].z});
        region.SetSize(a, std::size_t(g.size[a]));
    }
    io->SetIORegion(region);
    io->SetUseCompression(true);
    io->SetCompressionLevel(kZlibLevel);
    io->SetFileName(file.string());
    io->Write(volume.voxels.data());
}

template <class T>
itk::MetaImageIO::Pointer openVolume(const fs::path& file)
{
    auto io = openHeader(file);
    if (io->GetComponentType() != kComponent<T>)
        throw Error(ErrorCode::bad_input, "has another voxel type than expected", file.string());
    return io;
}

template <class T>
Volume<T> copyVoxels(const MappedFile& mapped, const VoxelBytes& bytes, const Grid& grid, const fs::path& file)
{
    Volume<T> volume;
    volume.grid = grid;
    try {
        fillFresh(volume.voxels, grid.voxelCount(), T{});
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::no_memory, "does not fit into memory", file.string(), "close other programs");
    }
    const std::span stored(mapped.data() + bytes.begin, bytes.count);
    const auto voxels = std::as_writable_bytes(std::span(volume.voxels));
    if (!bytes.packed)
        std::copy_n(stored.begin(), voxels.size(), voxels.begin());
    else if (!unpack(stored, voxels))
        throw Error(ErrorCode::bad_input, "is damaged: its voxels cannot be unpacked", file.string(),
                    "run 'vicon work' to make it anew");
    return volume;
}

}  // namespace

template <class T>
void writeVolume(const fs::path& file, const Volume<T>& volume, Packing packing)
{
    replaceFile(file, [&](const fs::path& temporary) {
        try {
            if (packing == Packing::raw)
                writeRaw(temporary, file, volume);
            else
                writePacked(temporary, volume);
        } catch (const itk::ExceptionObject&) {
            throw Error(ErrorCode::store, "cannot be written", file.string(), "check the disk's free space");
        }
        const auto least = packing == Packing::raw ? volume.voxels.size() * sizeof(T) + 1 : 1;
        if (!fs::exists(temporary) || fs::file_size(temporary) < least)
            throw Error(ErrorCode::store, "cannot be written completely", file.string(), "check the disk's free space");
    });
}

template <class T>
Volume<T> readVolume(const fs::path& file)
{
    const Grid grid = gridOf(*openVolume<T>(file), file);
    const VoxelBytes bytes = voxelBytesIn(file, grid.voxelCount() * sizeof(T));
    return copyVoxels<T>(MappedFile(file), bytes, grid, file);
}

template <class T>
StoredVolume<T>::StoredVolume(const fs::path& file)
{
    const Grid grid = gridOf(*openVolume<T>(file), file);
    const VoxelBytes bytes = voxelBytesIn(file, grid.voxelCount() * sizeof(T));
    auto mapped = std::make_shared<const MappedFile>(file);
    if (!bytes.packed && bytes.begin % kVoxelAlignment == 0) {
        const void* first = mapped->data() + bytes.begin;
        view_ = {grid, std::span(static_cast<const T*>(first), grid.voxelCount())};
        mapped_ = mapped.get();
        owner_ = std::move(mapped);
    } else {
        auto read = std::make_shared<const Volume<T>>(copyVoxels<T>(*mapped, bytes, grid, file));
        view_ = *read;
        owner_ = std::move(read);
    }
}

template <class T>
void StoredVolume<T>::readAhead(std::size_t begin, std::size_t end) const
{
    if (!mapped_)
        return;
    const auto first = std::size_t(reinterpret_cast<const std::byte*>(view_.voxels.data()) - mapped_->data());
    mapped_->readAhead(first + begin * sizeof(T), first + end * sizeof(T));
}

Grid readGrid(const fs::path& file)
{
    return gridOf(*openHeader(file), file);
}

template void writeVolume(const fs::path&, const Volume<std::int16_t>&, Packing);
template void writeVolume(const fs::path&, const Volume<std::uint8_t>&, Packing);
template void writeVolume(const fs::path&, const Volume<std::uint16_t>&, Packing);
template void writeVolume(const fs::path&, const Volume<float>&, Packing);
template Volume<std::int16_t> readVolume(const fs::path&);
template Volume<std::uint8_t> readVolume(const fs::path&);
template Volume<std::uint16_t> readVolume(const fs::path&);
template Volume<float> readVolume(const fs::path&);

template class StoredVolume<std::int16_t>;
template class StoredVolume<std::uint8_t>;
template class StoredVolume<std::uint16_t>;
template class StoredVolume<float>;

}  // namespace vicon::scan_files
