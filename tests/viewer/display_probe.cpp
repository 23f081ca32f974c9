// Holds a display until it is killed or its input ends; prints the display's name.
#include <unistd.h>

#include <cstdio>

#include "vicon/core/error.h"
#include "vicon/viewer/scene/display.h"

int main()
{
    try {
        const vicon::viewer::Display display;
        std::printf("%s\n", display.name().c_str());
        std::fflush(stdout);
        char byte = 0;
        while (::read(0, &byte, 1) > 0) {
        }
        return 0;
    } catch (const vicon::Error& e) {
        std::printf("%s\n", std::string(nameOf(e.code())).c_str());
        return 1;
    }
}
