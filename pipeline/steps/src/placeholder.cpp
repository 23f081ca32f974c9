namespace vicon { int pipeline_steps_placeholder() { return 0; } }
