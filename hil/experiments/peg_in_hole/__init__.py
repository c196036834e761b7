"""Section 2 of the paper and other worlds without physics: learners compared."""
