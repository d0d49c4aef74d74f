; program groove-on-a-line, SINUMERIK 840D
; part groove-on-a-line, aluminium, 4 mm thick
; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
; origin: axis of the part, Z0 on top of the stock
; origin G54, Z0 on top of the stock, units mm and mm/min
; T24 D 6 mm: mill-6, end mill
G17 G710 G40 G90 G94 COMPOF
G64
G0 SUPA Z0 D0
; operation: groove: slot
T24
M6
G54 S11671 M3
G0 X-30 Y-5
D1 Z5
M8
Z1
G1 Z0 F1750
X-10.899 Z-1 F880
X-30 Z-2
X0 F1750
G3 X9.32 Y1.376 I-0.001 J10.001
G2 X0 Y-5 I-9.321 J3.625
G1 X-30
G0 Z5
M9
M5
G0 SUPA Z0 D0
M30
