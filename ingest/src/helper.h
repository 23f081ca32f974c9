#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "image_object.h"

namespace vicon::ingest {

/// Decodes one compressed frame to little-endian pixels of `format`, in the decoder program; several threads may ask at
/// the same time. The stream has passed whyNotDecodable(). Throws Error{bad_input} without a subject when the stream
/// cannot be decoded, or twice ended the program; Error{internal} when there is no program.
std::vector<char> decodeInHelper(std::string_view stream, const PixelFormat& format,
                                 const std::string& transfer_syntax);

/// Why reading a file as DICOM does harm: it ended the decoder program, twice, or took too long there. Empty when it
/// does none, whether or not the file is DICOM.
std::string whyHarmful(const std::filesystem::path& file);

/// Why a file must not be given to a DICOM library: by its structure, or because reading it did harm when it was tried
/// in the decoder program. Empty when it may.
std::string whyNotToRead(const std::filesystem::path& file);

/// Ends the programs that wait for work. The next question starts one.
void endIdleHelpers();

}  // namespace vicon::ingest
