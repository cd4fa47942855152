"""What a client of the node has in common in ROS 1 and ROS 2: the messages of both are alike."""

from checks import fill, wait_for
from geometry_msgs.msg import Pose, PoseArray, PoseStamped


class Client:
    """The node as a client sees it. Its publisher of poses is `targets`; `states` are received."""

    pose = Pose

    def __init__(self, process):
        self.log = process.text
        self.states = []

    def publish(self, pose, frame):
        message = PoseStamped(pose=pose)
        message.header.frame_id = frame
        self.targets.publish(message)

    def pose_array(self, poses, frame):
        message = PoseArray(poses=[fill(Pose(), T) for T in poses])
        message.header.frame_id = frame
        return message

    def clear(self):
        self.states.clear()

    def joint_state(self, seconds):
        return self.states[-1] if wait_for(lambda: self.states, seconds) else None
