#pragma once

#include <QProgressBar>

#include "reading.h"

namespace vicon::viewer::test {

/// Corrections of the scan that is read, by the mouse.
class Correcting : public Reading {
protected:
    /// Presses this button of *Colon* and clicks where the path is at the top of the projection.
    static void correctAlongThePath(const char* button)
    {
        press(window(), button);
        click("overview", {the<QWidget>("overview")->width() / 2, the<QWidget>("overview")->height() / 5});
        ASSERT_TRUE(eventually([] { return the<QProgressBar>("redo")->isVisible(); })) << warning();
    }
    /// Until the corrected scan is shown.
    static void waitForNewScan()
    {
        ASSERT_TRUE(eventually([] { return !the<QProgressBar>("redo")->isVisible(); }));
        ASSERT_TRUE(eventually([] { return !the<QWidget>("opening")->isVisible(); }));
        waitForScan();
    }
};

}  // namespace vicon::viewer::test
