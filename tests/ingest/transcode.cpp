#include "transcode.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>

#include <stdexcept>

namespace fs = std::filesystem;

namespace vicon::test {
namespace {

void rewrite(const fs::path& from, const fs::path& to, E_TransferSyntax syntax)
{
    DcmFileFormat format;
    if (format.loadFile(from.c_str()).bad() || format.loadAllDataIntoMemory().bad() ||
        format.saveFile(to.c_str(), syntax).bad())
        throw std::runtime_error("DCMTK cannot rewrite " + from.string());
}

void compress(const fs::path& from, const fs::path& to, gdcm::TransferSyntax::TSType syntax)
{
    gdcm::ImageReader reader;
    reader.SetFileName(from.c_str());
    gdcm::ImageChangeTransferSyntax change;
    change.SetTransferSyntax(syntax);
    if (!reader.Read())
        throw std::runtime_error("GDCM cannot read " + from.string());
    change.SetInput(reader.GetImage());
    if (!change.Change())
        throw std::runtime_error("GDCM cannot encode " + from.string());
    gdcm::ImageWriter writer;
    writer.SetFileName(to.c_str());
    writer.SetFile(reader.GetFile());
    writer.SetImage(change.GetOutput());
    if (!writer.Write())
        throw std::runtime_error("GDCM cannot write " + to.string());
}

}  // namespace

void transcode(const fs::path& from, const fs::path& to, const std::string& transfer_syntax)
{
    const DcmXfer xfer(transfer_syntax.c_str());
    if (xfer.isEncapsulated())
        compress(from, to, gdcm::TransferSyntax::GetTSType(transfer_syntax.c_str()));
    else
        rewrite(from, to, xfer.getXfer());
}

}  // namespace vicon::test
