//! Tables with their frames and their zero pose anywhere.
