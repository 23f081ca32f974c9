namespace vicon { int report_placeholder() { return 0; } }
