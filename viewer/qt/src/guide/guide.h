#pragma once

#include <QString>

class QWidget;

namespace vicon::viewer {

/// All pages of the guide as one, in Markdown, without pictures; links lead to other pages of it alone.
QString guideText();

/// Opens the guide beside `window`, or turns it to another page where it is open.
/// @param heading a heading of the guide; where there is none of this name it opens at its beginning
void showGuide(QWidget& window, const QString& heading);

}  // namespace vicon::viewer
