namespace vicon { int pipeline_placeholder() { return 0; } }
