%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE Watch
    PROC main()
        WHILE TRUE DO
            WaitTime 1;
        ENDWHILE
    ENDPROC
ENDMODULE
