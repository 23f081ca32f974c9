namespace vicon { int phantom_placeholder() { return 0; } }
