"""The paper's neural baselines: DQL, AC, PG and PPO. Needs the extra `baselines` (torch, SB3)."""
