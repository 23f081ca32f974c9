#pragma once

#include <string>

namespace vicon::ingest {

/// Of transfer syntaxes, by UID.
bool isJpeg2000(const std::string& transfer_syntax);
bool isRle(const std::string& transfer_syntax);

/// Whether GDCM decodes these pixels: JPEG 2000, which DCMTK as packaged does not know, and JPEG-LS, where DCMTK 3.6.7
/// on Debian calls CharLS 2.4 without one of its arguments and so writes to an arbitrary address (found with valgrind).
bool isDecodedByGdcm(const std::string& transfer_syntax);

/// Whether compressed pixels of this syntax can be decoded at all.
bool isDecodable(const std::string& transfer_syntax);

}  // namespace vicon::ingest
