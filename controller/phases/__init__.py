"""One phase a file: generators that yield set-points in the task frame and receive cycles."""
