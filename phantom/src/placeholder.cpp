namespace vicon::phantom {
}
