#pragma once

#include <string>
#include <string_view>

namespace vicon {

// How names and dates of DICOM are shown to people, in the window, in pictures and in reports alike.

/// A DICOM person name for people: "Yamada^Tarou=山田^太郎=やまだ^たろう" becomes "Yamada, Tarou (山田 太郎, やまだ
/// たろう)". Family name first, then prefix, given and middle names, then the suffix; names in Han, kana and Hangul
/// take no comma, Arabic ones their own. Empty when no component says anything.
std::string printedName(std::string_view dicom_name);
/// The same of a patient; "name not given" where there is none.
std::string printedPatientName(std::string_view dicom_name);

/// "19610412" becomes "1961-04-12"; what is no such date is returned as it is.
std::string printedDate(std::string_view dicom_date);

}  // namespace vicon
