#include "vicon/artefact/volume_file.h"

#include <itkMetaImageIO.h>

#include <cstring>
#include <fstream>
#include <new>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::artefact {
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

itk::MetaImageIO::Pointer openHeader(const fs::path& file)
{
    if (!fs::exists(file))
        throw Error(ErrorCode::not_found, "no such file", file.string(), "run 'vicon work' to make it");
    auto io = itk::MetaImageIO::New();
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

Grid gridOf(itk::MetaImageIO& io)
{
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

/// The reader fills what a cut-off file lacks with zeros and says nothing, so the file's length is checked before.
void requireWholeFile(const fs::path& file, std::size_t voxel_bytes)
{
    std::string head(4096, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(in.gcount()));
    const auto value = [&](const std::string& key) -> std::string {
        const auto at = head.find(key + " = ");
        return at == std::string::npos ? ""
                                       : head.substr(at + key.size() + 3, head.find('\n', at) - at - key.size() - 3);
    };
    const auto local = head.find("ElementDataFile = LOCAL\n");
    if (local == std::string::npos)
        return;  // voxels in another file: not written by us, and the reader's business
    const std::string packed = value("CompressedDataSize");
    const std::size_t data = packed.empty() ? voxel_bytes : std::stoull(packed);
    if (fs::file_size(file) < local + std::strlen("ElementDataFile = LOCAL\n") + data)
        throw Error(ErrorCode::bad_input, "is cut off", file.string(), "run 'vicon work' to make it anew");
}

}  // namespace

template <class T>
void writeVolume(const fs::path& file, const Volume<T>& volume, Packing packing)
{
    replaceFile(file, [&](const fs::path& temporary) {
        auto io = itk::MetaImageIO::New();
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
        io->SetUseCompression(packing == Packing::zlib);
        io->SetCompressionLevel(kZlibLevel);
        io->SetFileName(temporary.string());
        try {
            io->Write(volume.voxels.data());
        } catch (const itk::ExceptionObject&) {
            throw Error(ErrorCode::store, "cannot be written", file.string(), "check the disk's free space");
        }
        const auto least = packing == Packing::raw ? volume.voxels.size() * sizeof(T) : 1;
        if (!fs::exists(temporary) || fs::file_size(temporary) < least)
            throw Error(ErrorCode::store, "cannot be written completely", file.string(), "check the disk's free space");
    });
}

template <class T>
Volume<T> readVolume(const fs::path& file)
{
    auto io = openHeader(file);
    if (io->GetComponentType() != kComponent<T>)
        throw Error(ErrorCode::bad_input, "has another voxel type than expected", file.string());
    Volume<T> volume;
    volume.grid = gridOf(*io);
    requireWholeFile(file, volume.grid.voxelCount() * sizeof(T));
    itk::ImageIORegion region(3);
    for (unsigned a = 0; a < 3; ++a)
        region.SetSize(a, std::size_t(volume.grid.size[a]));
    io->SetIORegion(region);
    try {
        volume.voxels.resize(volume.grid.voxelCount());
        io->Read(volume.voxels.data());
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::no_memory, "does not fit into memory", file.string(), "close other programs");
    } catch (const itk::ExceptionObject&) {
        throw Error(ErrorCode::bad_input, "is damaged or too short", file.string(), "run 'vicon work' to make it anew");
    }
    return volume;
}

Grid readGrid(const fs::path& file)
{
    return gridOf(*openHeader(file));
}

template void writeVolume(const fs::path&, const Volume<std::int16_t>&, Packing);
template void writeVolume(const fs::path&, const Volume<std::uint8_t>&, Packing);
template void writeVolume(const fs::path&, const Volume<std::uint16_t>&, Packing);
template void writeVolume(const fs::path&, const Volume<float>&, Packing);
template Volume<std::int16_t> readVolume(const fs::path&);
template Volume<std::uint8_t> readVolume(const fs::path&);
template Volume<std::uint16_t> readVolume(const fs::path&);
template Volume<float> readVolume(const fs::path&);

}  // namespace vicon::artefact
